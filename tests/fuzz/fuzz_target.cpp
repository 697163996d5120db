// libFuzzer's side. The program's name says which reader: `fuzz_ies` feeds `ies` (ci/fuzz makes these names).
//   fuzz_readers list                  every reader with the sources of its words and its seeds
//   fuzz_readers unpack NAME FOLDER    what is kept of a reader, one file an input
//   fuzz_readers pack FOLDER FILE BYTES   the inputs of a folder, the shortest first, as long as they are not more than so many bytes
#include "tests/fuzz/readers.h"

#include "scenarios/values/files.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

namespace {

namespace fs = std::filesystem;
using namespace fernlicht::fuzz;

constexpr double longest_s = 10.0; // of processor time for one input: 2 s as shipped; the sanitizers take five times as long

const Reader* reader = nullptr;
fs::path folder; ///< in memory, where ci/fuzz has TMPDIR there; it removes it

std::vector<Reader> all_readers() {
    std::vector<Reader> all;
    for (const auto& some : {scenarios_readers(), runner_readers()})
        all.insert(all.end(), some.begin(), some.end());
    return all;
}

const Reader& reader_called(const std::string& name) {
    static const std::vector<Reader> all = all_readers();
    const auto found = std::ranges::find(all, name, &Reader::name);
    if (found == all.end()) {
        std::fprintf(stderr, "fuzz_readers: no reader '%s'\n", name.c_str());
        std::exit(2);
    }
    return *found;
}

void list() {
    for (const Reader& one : all_readers())
        std::printf("%s|%s|%s\n", std::string(one.name).c_str(), std::string(one.words).c_str(), std::string(one.seeds).c_str());
}

void unpack(const std::string& name, const fs::path& to) {
    for (const std::string& input : kept_inputs(reader_called(name), FERNLICHT_SOURCE_DIR "/tests/fuzz"))
        fernlicht::write_file(to / fernlicht::content_hash(input.data(), input.size()), input);
}

void pack(const fs::path& from, const fs::path& to, std::size_t most_bytes) {
    std::vector<std::string> inputs;
    for (const fs::directory_entry& entry : fs::directory_iterator(from)) {
        fernlicht::FilesRead opened;
        inputs.push_back(fernlicht::read_file(entry.path(), opened, most_bytes, true));
    }
    std::ranges::sort(inputs, {}, [](const std::string& input) { return std::pair(input.size(), input); });
    std::size_t bytes = 0;
    std::erase_if(inputs, [&](const std::string& input) { return (bytes += input.size()) > most_bytes; });
    fernlicht::write_file(to, packed(inputs));
}

double processor_s() {
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

} // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** words) {
    const std::vector<std::string> given(*words, *words + *count);
    const std::string program = fs::path(given[0]).filename();
    const std::string task = given.size() > 1 ? given[1] : "";
    if (program == "fuzz_readers") {
        if (task == "list")
            list();
        else if (task == "unpack" && given.size() == 4)
            unpack(given[2], given[3]);
        else if (task == "pack" && given.size() == 5)
            pack(given[2], given[3], std::stoul(given[4]));
        else
            std::fprintf(stderr, "fuzz_readers list, unpack NAME FOLDER or pack FOLDER FILE BYTES; readers are fuzzed by ci/fuzz\n"),
                std::exit(2);
        std::exit(0);
    }
    reader = &reader_called(program.substr(std::string("fuzz_").size()));
    folder = fs::temp_directory_path() / ("fuzz-" + std::to_string(::getpid()));
    make_companions(folder);
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const double began_s = processor_s();
    feed(*reader, {reinterpret_cast<const char*>(data), size}, folder);
    if (const double took_s = processor_s() - began_s; took_s > longest_s) {
        std::fprintf(stderr, "ERROR: took %.1f s of the processor's time, more than %.0f s\n", took_s, longest_s);
        std::abort();
    }
    return 0;
}
