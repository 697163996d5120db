#include "runner/files/output_folder.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <system_error>
#include <unistd.h>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

constexpr const char* mark_name = "INCOMPLETE";
constexpr std::size_t longest_name = 120; // most file systems end at 255 bytes, and files in it need theirs

std::string plain_name(const std::string& name) {
    std::string out;
    for (const char c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_';
        if (plain)
            out += c;
        else if (!out.empty() && out.back() != '-')
            out += '-';
    }
    out.resize(std::min(out.size(), longest_name));
    out.erase(0, out.find_first_not_of(".-")); // neither hidden nor an option
    while (!out.empty() && out.back() == '-')
        out.pop_back();
    return out.empty() ? "drive" : out;
}

/// What lies in a folder that is not empty, for the sentence that refuses it.
std::string contents(const fs::path& folder) {
    if (fs::exists(folder / mark_name))
        return "holds a run that did not end";
    if (fs::exists(folder / "report.json"))
        return "holds another run";
    return fmt::format("is not empty (it holds '{}')", printable(fs::directory_iterator(folder)->path().filename().string()));
}

/// Whether another folder would do, or no disk does.
bool is_users_choice(int error) { return error != ENOSPC && error != EIO && error != EDQUOT && error != EMFILE && error != ENFILE; }

/// Made, not overwritten: of two runs that start at once in one folder the second is refused.
void put_mark(const fs::path& folder) {
    const fs::path mark = folder / mark_name;
    const int file = ::open(mark.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    const int error = errno;
    if (file < 0 && error == EEXIST)
        throw InputError({folder, 0, 0, "--out"}, contents(folder), "a new or an empty folder");
    if (file < 0 && is_users_choice(error))
        throw InputError({folder, 0, 0, "--out"}, "cannot be written to: " + std::generic_category().message(error),
                         "a folder that can be written to");
    if (file < 0)
        throw DeviceError(printable(mark.string(), 400) + ": cannot be written: " + std::generic_category().message(error));
    ::close(file);
    write_file(mark, "This run has not ended: results may be missing.\n");
}

} // namespace

fs::path default_output_folder(const std::string& drive, const std::string& started_utc) {
    std::string time;
    for (const char c : started_utc)
        if (c != '-' && c != ':')
            time += c;
    const fs::path first = fs::path("out") / (plain_name(drive) + "-" + plain_name(time));
    fs::path folder = first;
    std::error_code ignored;
    for (int number = 2; fs::exists(folder, ignored); ++number)
        folder = first.string() + fmt::format("-{}", number);
    return folder;
}

OutputFolder::OutputFolder(fs::path folder) : folder_(std::move(folder)) {
    try {
        if (fs::exists(folder_)) {
            if (!fs::is_directory(folder_))
                throw InputError({folder_, 0, 0, "--out"}, "is not a folder", "a new or an empty folder");
            if (!fs::is_empty(folder_))
                throw InputError({folder_, 0, 0, "--out"}, contents(folder_), "a new or an empty folder");
        }
        fs::create_directories(folder_);
    } catch (const fs::filesystem_error& error) {
        if (is_users_choice(error.code().value()))
            throw InputError({folder_, 0, 0, "--out"}, "cannot be made or used: " + error.code().message(),
                             "a folder that can be written to");
        throw DeviceError(printable(folder_.string(), 400) + ": cannot be made or used as output folder: " + error.code().message());
    }
    put_mark(folder_);
}

OutputFolder OutputFolder::left_incomplete(const fs::path& folder) {
    if (std::error_code ignored; !fs::exists(folder, ignored))
        throw InputError({folder, 0, 0, "--out"}, "there is no such folder", "the folder of a run that did not end");
    if (!is_marked_incomplete(folder))
        throw InputError({folder, 0, 0, "--out"}, "holds nothing that was interrupted", "the folder of a run that did not end");
    OutputFolder out;
    out.folder_ = folder;
    return out;
}

void OutputFolder::finish() {
    std::error_code error;
    fs::remove(folder_ / mark_name, error);
    if (error)
        throw DeviceError(printable((folder_ / mark_name).string(), 400) + ": cannot be removed: " + error.message());
}

void refuse_unwritable(const char* flag, const fs::path& given, const fs::path& made, bool replaces) {
    const fs::path file = fs::absolute(given).lexically_normal(), run = made.empty() ? made : fs::absolute(made).lexically_normal();
    const auto refuse = [&](const std::string& found, const char* expected) { throw InputError({{}, 0, 0, flag}, found, expected); };
    std::error_code ignored;
    if (fs::exists(fs::symlink_status(file, ignored)) && !(replaces && fs::is_regular_file(file, ignored)))
        refuse(printable(given.string(), 400) + (replaces ? " is no file" : " is there already"), "a new file");
    if (!file.has_filename() || file == run)
        refuse(printable(given.string(), 400) + " is a folder", "a new file");
    const fs::path folder = file.parent_path();
    if (folder != run && !fs::is_directory(folder, ignored))
        refuse("there is no folder " + printable(folder.string(), 400), "a new file in a folder that is there");
    if (folder != run && ::access(folder.c_str(), W_OK | X_OK) != 0)
        refuse(printable(folder.string(), 400) + " cannot be written to", "a new file in a folder that can");
}

bool is_marked_incomplete(const fs::path& folder) {
    std::error_code ignored;
    return fs::exists(folder / mark_name, ignored);
}

std::string file_name_of(const std::string& text) {
    std::string name;
    for (const char c : text.substr(0, 80)) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
                           (c == '.' && !name.empty());
        name += plain ? c : '_';
    }
    return name.empty() ? "_" : name;
}

std::string FileNames::of(const std::string& text) {
    const std::string plain = file_name_of(text);
    std::string name = plain;
    for (int i = 2; !given_.insert(name).second; ++i)
        name = plain + "-" + std::to_string(i);
    return name;
}

} // namespace fernlicht
