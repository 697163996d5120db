// fernlicht-zip.so: what is in an archive.
#include "scenarios/control/fmu/zip_module.h"

#include <array>
#include <memory>
#include <stdexcept>
#include <zip.h>

namespace fernlicht {
namespace {

using ZipArchive = std::unique_ptr<zip_t, decltype(&zip_discard)>;
using ZipEntry = std::unique_ptr<zip_file_t, decltype(&zip_fclose)>;

std::invalid_argument open_error(int code) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string reason = zip_error_strerror(&error);
    zip_error_fini(&error);
    return std::invalid_argument(reason);
}

void unpack(zip_t* archive, zip_uint64_t index, const zip_stat_t& entry, const ZipReader& reader) {
    const auto refuse = [&](const std::string& reason) { throw std::invalid_argument(std::string(entry.name) + ": " + reason); };
    const ZipEntry file(zip_fopen_index(archive, index, 0), &zip_fclose);
    if (!file)
        refuse(zip_error_strerror(zip_get_error(archive)));
    std::array<char, 1U << 16U> piece{};
    zip_uint64_t got = 0;
    for (zip_int64_t more = 1; more > 0 && got <= entry.size;) { // to its end, where the checksum is compared
        if ((more = zip_fread(file.get(), piece.data(), piece.size())) < 0)
            refuse(zip_error_strerror(zip_file_get_error(file.get())));
        got += static_cast<zip_uint64_t>(more);
        if (more > 0 && got <= entry.size)
            reader.take({piece.data(), static_cast<std::size_t>(more)});
    }
    if (got != entry.size)
        refuse("another length than the archive says");
}

} // namespace

extern "C" __attribute__((visibility("default"))) void fernlicht_read_zip(const std::string& file, const ZipReader& reader) {
    int code = 0;
    const ZipArchive archive(zip_open(file.c_str(), ZIP_RDONLY, &code), &zip_discard);
    if (!archive)
        throw open_error(code);
    const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
    for (zip_int64_t i = 0; i < count; ++i) {
        const auto index = static_cast<zip_uint64_t>(i);
        zip_stat_t entry;
        if (zip_stat_index(archive.get(), index, 0, &entry) != 0 || (entry.valid & ZIP_STAT_NAME) == 0 ||
            (entry.valid & ZIP_STAT_SIZE) == 0)
            throw std::invalid_argument("an entry without name or length");
        if (reader.wants(entry.name, entry.size))
            unpack(archive.get(), index, entry, reader);
    }
}

static_assert(std::is_same_v<decltype(fernlicht_read_zip), ReadZip>);

} // namespace fernlicht
