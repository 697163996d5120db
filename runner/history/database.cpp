#include "runner/history/database.h"

#include "runner/files/durable_files.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <fmt/format.h>
#include <linux/magic.h>
#include <sqlite3.h>
#include <sys/vfs.h>
#include <thread>

namespace fernlicht {

struct Database::Handle {
    sqlite3* connection = nullptr;
    Handle() = default;
    ~Handle() { sqlite3_close(connection); }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
};

struct Statement::Handle {
    sqlite3_stmt* prepared = nullptr;
};

namespace {

constexpr int wait_ms = 60'000;

constexpr std::int64_t zfs_magic = 0x2fc12fc1; // OpenZFS, include/os/linux/zfs/sys/zfs_vfsops_os.h
constexpr std::array<std::int64_t, 7> local_file_systems{EXT4_SUPER_MAGIC, XFS_SUPER_MAGIC,       BTRFS_SUPER_MAGIC, F2FS_SUPER_MAGIC,
                                                         TMPFS_MAGIC,      OVERLAYFS_SUPER_MAGIC, zfs_magic}; // ext2, ext3 as ext4

[[noreturn]] void fail_with(const std::filesystem::path& file, int code, const std::string& says) {
    switch (code & 0xff) {
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
    case SQLITE_FORMAT:
        throw InputError({file, 0, 0, {}}, "is damaged or no database (" + says + ")", "a file that `fernlicht history add` wrote");
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
        throw DeviceError(fmt::format("{}: another process has been writing for {} s", printable(file.string(), 400), wait_ms / 1000));
    case SQLITE_IOERR:
        throw DeviceError(fmt::format("{}: {} (is its disk full?)", printable(file.string(), 400), says));
    default:
        throw DeviceError(fmt::format("{}: {}", printable(file.string(), 400), says));
    }
}

[[noreturn]] void fail_with(const std::filesystem::path& file, sqlite3* connection) {
    fail_with(file, sqlite3_extended_errcode(connection), sqlite3_errmsg(connection));
}

} // namespace

bool is_local_file_system(std::int64_t type) { return std::ranges::find(local_file_systems, type) != local_file_systems.end(); }

Database::Database(std::filesystem::path file, For what) : file_(std::move(file)) {
    std::error_code ignored;
    if (what == For::reading) {
        if (!std::filesystem::is_regular_file(file_, ignored))
            throw InputError({file_, 0, 0, {}}, "is no file", "a history; `fernlicht history add FOLDER` begins one");
        if (std::filesystem::file_size(file_, ignored) == 0)
            throw InputError({file_, 0, 0, {}}, "is empty", "a history; `fernlicht history add FOLDER` begins one");
        open(false, false);
        // A reader of a file with write-ahead logging makes an index beside it. Where it cannot, the file is read as it lies there.
        const int code = sqlite3_exec(handle_->connection, "SELECT * FROM sqlite_schema LIMIT 1", nullptr, nullptr, nullptr) & 0xff;
        if (code == SQLITE_CANTOPEN || code == SQLITE_READONLY) {
            if (const std::filesystem::path log = file_.string() + "-wal";
                std::filesystem::exists(log, ignored) && std::filesystem::file_size(log) > 0)
                throw DeviceError(
                    fmt::format("{}: what was added last stands in {}, which cannot be read on a disk that cannot be written to",
                                printable(file_.string(), 400), printable(log.filename().string())));
            open(false, true);
        }
        return;
    }
    if (std::filesystem::is_directory(file_, ignored))
        throw InputError({file_, 0, 0, {}}, "is a folder", "a history, or the name of a new file");
    const std::filesystem::path folder = std::filesystem::absolute(file_).parent_path();
    make_folder(folder);
    const FolderLock lock(folder); // two that begin one file
    const bool is_new = !std::filesystem::exists(file_, ignored) || std::filesystem::file_size(file_, ignored) == 0;
    open(true, false);
    // One with a rollback journal has been tried, though it may not hold anything yet; its first process may be at work.
    if (is_new || text_of("PRAGMA journal_mode") == "wal")
        try_write_ahead();
    run("PRAGMA synchronous=FULL");
}

Database::~Database() = default;

void Database::open(bool writing, bool immutable) {
    handle_ = std::make_unique<Handle>();
    std::string name = "file:";
    for (const char c : std::filesystem::absolute(file_).string())
        name += c == '%' || c == '?' || c == '#' ? fmt::format("%{:02X}", static_cast<unsigned char>(c)) : std::string(1, c);
    const int flags = SQLITE_OPEN_URI | (writing ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READONLY);
    if (sqlite3_open_v2((name + (immutable ? "?immutable=1" : "")).c_str(), &handle_->connection, flags, nullptr) != SQLITE_OK)
        fail_with(file_, handle_->connection);
    sqlite3_extended_result_codes(handle_->connection, 1);
    sqlite3_busy_timeout(handle_->connection, wait_ms);
}

bool Database::is_local() const {
    std::error_code ignored;
    const std::filesystem::path folder = std::filesystem::weakly_canonical(std::filesystem::absolute(file_), ignored).parent_path();
    struct ::statfs disk {};
    return ::statfs(folder.c_str(), &disk) == 0 && is_local_file_system(disk.f_type);
}

void Database::try_write_ahead() {
    // Switching asks for the file alone and does not wait by itself.
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::milliseconds(wait_ms);
    const auto says = [&](const char* sql) { return sqlite3_exec(handle_->connection, sql, nullptr, nullptr, nullptr); };
    // Between machines the index of the log is not shared, which a transaction on one of them does not find out (sqlite.org/wal.html).
    int code = is_local() ? says("PRAGMA journal_mode=WAL") : SQLITE_IOERR;
    while ((code & 0xff) == SQLITE_BUSY && std::chrono::steady_clock::now() < give_up) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        code = says("PRAGMA journal_mode=WAL");
    }
    if (code == SQLITE_OK)
        code = says("BEGIN IMMEDIATE; COMMIT");
    if (code == SQLITE_OK)
        return;
    if ((code & 0xff) == SQLITE_NOTADB || (code & 0xff) == SQLITE_CORRUPT || (code & 0xff) == SQLITE_BUSY)
        fail_with(file_, handle_->connection);
    // Alone, a file with write-ahead logging can be read without what is missing here, and be given the other journal.
    open(true, false);
    run("PRAGMA locking_mode=EXCLUSIVE; PRAGMA journal_mode=DELETE; PRAGMA locking_mode=NORMAL; BEGIN IMMEDIATE; COMMIT");
}

void Database::run(const std::string& sql) {
    if (sqlite3_exec(handle_->connection, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
        fail_with(file_, handle_->connection);
}

std::string Database::text_of(const std::string& sql) {
    Statement statement(*this, sql);
    return statement.step() ? statement.text(0) : "";
}

std::int64_t Database::whole_of(const std::string& sql) {
    Statement statement(*this, sql);
    return statement.step() ? statement.whole(0) : 0;
}

std::int64_t Database::last_row() const { return sqlite3_last_insert_rowid(handle_->connection); }
std::int64_t Database::rows_changed() const { return sqlite3_changes64(handle_->connection); }

Statement::Statement(Database& database, const std::string& sql) : database_(database), handle_(std::make_unique<Handle>()) {
    if (sqlite3_prepare_v2(database.handle_->connection, sql.c_str(), -1, &handle_->prepared, nullptr) != SQLITE_OK)
        fail_with(database.file_, database.handle_->connection);
}

Statement::~Statement() { sqlite3_finalize(handle_->prepared); }

Statement& Statement::bind(int place, std::int64_t value) {
    sqlite3_bind_int64(handle_->prepared, place, value);
    return *this;
}
Statement& Statement::bind(int place, double value) {
    sqlite3_bind_double(handle_->prepared, place, value);
    return *this;
}
Statement& Statement::bind(int place, const std::string& value) {
    sqlite3_bind_text(handle_->prepared, place, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT);
    return *this;
}
Statement& Statement::bind_null(int place) {
    sqlite3_bind_null(handle_->prepared, place);
    return *this;
}

bool Statement::step() {
    const int code = sqlite3_step(handle_->prepared);
    if (code == SQLITE_ROW)
        return true;
    if (code != SQLITE_DONE)
        fail_with(database_.file_, database_.handle_->connection);
    sqlite3_reset(handle_->prepared);
    return false;
}

void Statement::run() {
    while (step())
        continue;
}

std::int64_t Statement::whole(int column) const { return sqlite3_column_int64(handle_->prepared, column); }
std::optional<double> Statement::number(int column) const {
    return is_null(column) ? std::nullopt : std::optional(sqlite3_column_double(handle_->prepared, column));
}
std::string Statement::text(int column) const {
    const unsigned char* const text = sqlite3_column_text(handle_->prepared, column);
    return text
               ? std::string(reinterpret_cast<const char*>(text), static_cast<std::size_t>(sqlite3_column_bytes(handle_->prepared, column)))
               : std::string();
}
bool Statement::is_null(int column) const { return sqlite3_column_type(handle_->prepared, column) == SQLITE_NULL; }

Transaction::Transaction(Database& database) : database_(database) { database_.run("BEGIN IMMEDIATE"); }
Transaction::~Transaction() {
    if (open_)
        try {
            database_.run("ROLLBACK");
        } catch (const std::exception&) { // the error that leads here has undone it
            return;
        }
}
void Transaction::commit() {
    database_.run("COMMIT");
    open_ = false;
}

void migrate(Database& database, std::int64_t mark, std::span<const char* const> steps) {
    const auto newest = static_cast<std::int64_t>(steps.size());
    const auto check = [&] {
        const std::int64_t version = database.whole_of("PRAGMA user_version"), found = database.whole_of("PRAGMA application_id");
        const bool is_new = found == 0 && version == 0 && database.whole_of("SELECT count(*) FROM sqlite_schema") == 0;
        if (!is_new && found != mark)
            throw InputError({database.file(), 0, 0, {}}, "is a database of another program",
                             "a file that `fernlicht history add` wrote, or a new name");
        if (version < 0)
            throw InputError({database.file(), 0, 0, {}}, fmt::format("is a history of version {}", version), "one that is not damaged");
        if (version > newest)
            throw InputError({database.file(), 0, 0, {}}, fmt::format("is a history of version {}", version),
                             fmt::format("version {} or older: a newer fernlicht wrote it", newest));
        return version;
    };
    if (check() == newest)
        return;
    Transaction transaction(database);
    for (std::int64_t version = check(); version < newest; ++version) // another process may have been first
        database.run(steps[static_cast<std::size_t>(version)]);
    database.run(fmt::format("PRAGMA application_id={}; PRAGMA user_version={}", mark, newest));
    transaction.commit();
}

} // namespace fernlicht
