// One SQLite file: statements, transactions, and errors that name the file. The only door to SQLite.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace fernlicht {

class Statement;

/// By statfs()'s f_type: whether one machine alone mounts it, as far as is known.
bool is_local_file_system(std::int64_t type);

class Database {
  public:
    enum class For { reading, writing };

    /// Writing: makes the file and its folder where they are not there, and waits up to a minute while others write. A new file gets
    /// write-ahead logging (WAL), so that readers and writer do not wait for each other; on file systems that are not known as local, as
    /// network disks, and where a first transaction finds that it does not work, the file gets a rollback journal, and keeps it. Reading
    /// changes nothing on the disk.
    /// Errors of this and all below: InputError for a file that is not there, damaged or no database; DeviceError for what the disk
    /// refuses, or where another process writes for longer than a minute.
    Database(std::filesystem::path file, For what);
    ~Database();
    Database(const Database&) = delete;
    Database& operator=(const Database&) = delete;

    void run(const std::string& sql); ///< any number of statements without values
    std::string text_of(const std::string& sql);
    std::int64_t whole_of(const std::string& sql);
    std::int64_t last_row() const; ///< number of the row that was inserted last
    std::int64_t rows_changed() const;
    const std::filesystem::path& file() const { return file_; }

  private:
    friend class Statement;
    struct Handle;
    void open(bool writing, bool immutable);
    bool is_local() const;
    void try_write_ahead();
    std::filesystem::path file_;
    std::unique_ptr<Handle> handle_;
};

/// Values are numbered from 1, columns from 0. A statement does not outlive its database.
class Statement {
  public:
    Statement(Database& database, const std::string& sql);
    ~Statement();
    Statement(const Statement&) = delete;
    Statement& operator=(const Statement&) = delete;

    Statement& bind(int place, std::int64_t value);
    Statement& bind(int place, double value);
    Statement& bind(int place, const std::string& value);
    template <class T> Statement& bind(int place, const std::optional<T>& value) { return value ? bind(place, *value) : bind_null(place); }
    Statement& bind_null(int place);
    /// To the next row; false after the last one, and then the statement is ready for new values.
    bool step();
    void run(); ///< of one that gives no rows

    std::int64_t whole(int column) const;
    std::optional<double> number(int column) const; ///< nullopt for null
    std::string text(int column) const;
    bool is_null(int column) const;

  private:
    struct Handle;
    Database& database_;
    std::unique_ptr<Handle> handle_;
};

/// Begins at once, so that whoever writes waits before it reads what it builds on; undone unless committed.
class Transaction {
  public:
    explicit Transaction(Database& database);
    ~Transaction();
    Transaction(const Transaction&) = delete;
    Transaction& operator=(const Transaction&) = delete;
    void commit();

  private:
    Database& database_;
    bool open_ = true;
};

/// Brings the file to version steps.size(): step i makes version i + 1 of version i, all or nothing, and a new file begins at 0. `mark`
/// (SQLite's application_id) tells our files from those of others. Throws InputError for a file of another program and for a newer version.
void migrate(Database& database, std::int64_t mark, std::span<const char* const> steps);

} // namespace fernlicht
