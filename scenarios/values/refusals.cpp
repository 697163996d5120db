#include "scenarios/values/refusals.h"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace fernlicht {
namespace {

struct Met {
    std::vector<InputError> errors;
    std::set<std::pair<std::filesystem::path, std::string>> meant; ///< keys that stand there by another name
};

thread_local Met* listening = nullptr;

void keep(const InputError& error) {
    const std::string_view text = error.what();
    const bool is_misspelt =
        text.find(": missing") != std::string_view::npos && listening->meant.contains({error.where().file, error.where().key});
    const auto same = [&](const InputError& one) { return one.what() == text; };
    if (!is_misspelt && std::ranges::none_of(listening->errors, same))
        listening->errors.push_back(error);
}

} // namespace

std::vector<InputError> all_refusals(const std::function<void()>& reads) {
    Met met;
    Met* const before = std::exchange(listening, &met);
    const auto stop = [&] { listening = before; };
    try {
        reads();
    } catch (const InputError& error) {
        keep(error);
    } catch (...) {
        stop();
        throw;
    }
    stop();
    return std::move(met.errors);
}

std::size_t refusals_met() { return listening ? listening->errors.size() : 0; }

void refuse_and_go_on(const InputError& error, const std::string& meant) {
    if (!listening)
        throw error;
    keep(error);
    if (!meant.empty())
        listening->meant.emplace(error.where().file, meant);
}

void EachRead::note(const InputError& error) {
    if (!listening)
        throw; // as it is
    keep(error);
    if (!first_)
        first_ = error;
}

void EachRead::end() const {
    if (first_)
        throw *first_;
}

} // namespace fernlicht
