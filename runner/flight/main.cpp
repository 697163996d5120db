// fernlicht-import FILE OUT FORWARD: what `fernlicht import` starts, apart so that OpenSceneGraph burdens nothing else.
#include "runner/flight/flight_model.h"
#include "scenarios/models/model.h"
#include "scenarios/values/errors.h"

#include <exception>
#include <fmt/format.h>
#include <new>
#include <string_view>

int main(int argc, char** argv) {
    try {
        if (argc != 4) {
            fmt::print(stderr, "fernlicht-import is started by fernlicht import\n");
            return 2;
        }
        const auto forward = std::string_view(argv[3]) == "x" ? fernlicht::FlightForward::x : fernlicht::FlightForward::y;
        const fernlicht::FlightModel read = fernlicht::read_flight(argv[1], forward);
        fernlicht::write_file(argv[2], fernlicht::glb_of(read.model, read.pictures));
        for (const std::string& note : read.model.notes)
            fmt::print("{}\n", note);
        return 0;
    } catch (const fernlicht::InputError& error) {
        fmt::print(stderr, "{}", error.what());
        return 2;
    } catch (const fernlicht::DeviceError& error) {
        fmt::print(stderr, "{}", error.what());
        return 3;
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "{}: it needs more memory than the 4 GiB that a model may take", argv[1]);
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}", error.what());
        return 4;
    }
}
