#include "runner/history/history.h"

#include "runner/history/database.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// Equal inputs and equal readings are kept once: a night in which nothing changed takes a line a cell. Numbers are IEEE doubles, and come
/// back to the last bit.
constexpr const char* first_tables = R"(
CREATE TABLE nights (
    number INTEGER PRIMARY KEY,
    study TEXT NOT NULL,
    played_utc TEXT NOT NULL,
    folder TEXT NOT NULL,
    accepted INTEGER NOT NULL DEFAULT 0,
    note TEXT NOT NULL DEFAULT '',
    machine INTEGER NOT NULL REFERENCES input_sets,
    decide TEXT NOT NULL,
    UNIQUE (study, played_utc, folder));
CREATE TABLE input_sets (number INTEGER PRIMARY KEY, hash TEXT NOT NULL UNIQUE);
CREATE TABLE inputs (
    input_set INTEGER NOT NULL REFERENCES input_sets,
    place INTEGER NOT NULL,
    kind TEXT NOT NULL,
    name TEXT NOT NULL,
    hash TEXT NOT NULL,
    PRIMARY KEY (input_set, place)) WITHOUT ROWID;
CREATE TABLE results (number INTEGER PRIMARY KEY, hash TEXT NOT NULL UNIQUE);
CREATE TABLE readings (
    result INTEGER NOT NULL REFERENCES results,
    name TEXT NOT NULL,
    bound TEXT NOT NULL,
    figure REAL,
    why_not TEXT NOT NULL,
    PRIMARY KEY (result, name)) WITHOUT ROWID;
CREATE TABLE cells (
    night INTEGER NOT NULL REFERENCES nights,
    place INTEGER NOT NULL,
    name TEXT NOT NULL,
    drive TEXT NOT NULL,
    lamp TEXT NOT NULL,
    technique TEXT NOT NULL,
    condition TEXT NOT NULL,
    failed TEXT NOT NULL,
    input_set INTEGER NOT NULL REFERENCES input_sets,
    result INTEGER NOT NULL REFERENCES results,
    result_with_earlier_inputs INTEGER REFERENCES results,
    frame_s REAL,
    PRIMARY KEY (night, place)) WITHOUT ROWID;
CREATE INDEX cells_by_result ON cells (result);
CREATE VIEW every_reading AS
    SELECT n.study, n.number AS night, n.played_utc, n.accepted, c.name AS cell, c.drive, c.lamp, c.technique, c.condition,
           r.name AS reading, r.bound, r.figure, r.why_not
    FROM nights n JOIN cells c ON c.night = n.number JOIN readings r ON r.result = c.result;
)";

/// A file of version n was made by the first n of them: none is ever changed, new ones come behind.
constexpr std::array steps{first_tables};

constexpr std::array bounds{"not_measured", "at_most", "number", "at_least"}; // in the order of Value::Kind

std::string bound_of(const Value& value) { return bounds[static_cast<std::size_t>(value.kind())]; }

Value value_of_row(const std::filesystem::path& file, const std::string& bound, const std::optional<double>& figure,
                   const std::string& why) {
    if (bound == bounds[0])
        return Value::not_measured(why);
    if (figure && bound == "number")
        return *figure;
    if (figure && bound == "at_least")
        return Value::at_least(*figure);
    if (figure && bound == "at_most")
        return Value::at_most(*figure);
    throw InputError({file, 0, 0, "readings"}, "found the bound '" + printable(bound) + "'", "number, at_least, at_most or not_measured");
}

InputKind kind_of_row(const std::filesystem::path& file, const std::string& kind) {
    for (int i = 0; i <= static_cast<int>(InputKind::device); ++i)
        if (kind == input_kind_name(static_cast<InputKind>(i)))
            return static_cast<InputKind>(i);
    throw InputError({file, 0, 0, "inputs"}, "found the kind '" + printable(kind) + "'", "a kind of input that this fernlicht knows");
}

std::string hash_of_text(const std::string& text) { return content_hash(text.data(), text.size()); }

std::string hash_of_set(const CellInputs& inputs) {
    std::string all;
    for (const CellInput& input : inputs)
        all += fmt::format("{}\n{}\n{}\n", input_kind_name(input.kind), input.name, input.hash);
    return hash_of_text(all);
}

std::string hash_of_result(const NightReadings& readings) {
    std::string all;
    for (const auto& [name, value] : readings)
        all += fmt::format("{}\n{}\n{}\n{}\n", name, bound_of(value), value.figure().value_or(0.0) + 0.0, value.reason());
    return hash_of_text(all);
}

} // namespace

struct History::Tables {
    Database database;
    Tables(const std::filesystem::path& file, Database::For what) : database(file, what) {}

    /// The number of what has this hash in the table, made new by `insert` where there is none.
    template <class Insert> std::int64_t kept_once(const char* table, const std::string& hash, Insert insert) {
        Statement find(database, fmt::format("SELECT number FROM {} WHERE hash = ?1", table));
        if (find.bind(1, hash).step())
            return find.whole(0);
        Statement(database, fmt::format("INSERT INTO {} (hash) VALUES (?1)", table)).bind(1, hash).run();
        const std::int64_t number = database.last_row();
        insert(number);
        return number;
    }

    std::int64_t set_of(const CellInputs& inputs) {
        return kept_once("input_sets", hash_of_set(inputs), [&](std::int64_t set) {
            Statement row(database, "INSERT INTO inputs VALUES (?1, ?2, ?3, ?4, ?5)");
            std::int64_t place = 0;
            for (const CellInput& input : inputs)
                row.bind(1, set)
                    .bind(2, place++)
                    .bind(3, std::string(input_kind_name(input.kind)))
                    .bind(4, input.name)
                    .bind(5, input.hash)
                    .run();
        });
    }

    std::int64_t result_of(const NightReadings& readings) {
        return kept_once("results", hash_of_result(readings), [&](std::int64_t result) {
            Statement row(database, "INSERT INTO readings VALUES (?1, ?2, ?3, ?4, ?5)");
            for (const auto& [name, value] : readings)
                row.bind(1, result).bind(2, name).bind(3, bound_of(value)).bind(4, value.figure()).bind(5, value.reason()).run();
        });
    }

    void refuse_unknown(std::int64_t number) {
        Statement find(database, "SELECT 1 FROM nights WHERE number = ?1");
        if (!find.bind(1, number).step())
            throw InputError({database.file(), 0, 0, {}}, fmt::format("has no night {}", number),
                             "a number that `fernlicht history show` lists");
    }

    template <class Kept> Kept& at_row(const std::map<std::int64_t, std::shared_ptr<Kept>>& all, std::int64_t number) const {
        const auto found = all.find(number);
        if (found == all.end())
            throw InputError({database.file(), 0, 0, {}}, fmt::format("is damaged: row {} is missing", number),
                             "a file that `fernlicht history add` wrote");
        return *found->second;
    }

    std::map<std::int64_t, std::shared_ptr<CellInputs>> all_sets() {
        std::map<std::int64_t, std::shared_ptr<CellInputs>> sets;
        Statement numbers(database, "SELECT number FROM input_sets");
        while (numbers.step())
            sets[numbers.whole(0)] = std::make_shared<CellInputs>();
        Statement rows(database, "SELECT input_set, kind, name, hash FROM inputs ORDER BY input_set, place");
        while (rows.step())
            at_row(sets, rows.whole(0)).push_back({kind_of_row(database.file(), rows.text(1)), rows.text(2), rows.text(3)});
        return sets;
    }

    std::map<std::int64_t, std::shared_ptr<NightReadings>> all_results() {
        std::map<std::int64_t, std::shared_ptr<NightReadings>> results;
        Statement numbers(database, "SELECT number FROM results");
        while (numbers.step())
            results[numbers.whole(0)] = std::make_shared<NightReadings>();
        Statement rows(database, "SELECT result, name, bound, figure, why_not FROM readings ORDER BY result, name");
        while (rows.step()) {
            NightReadings& readings = at_row(results, rows.whole(0));
            readings.emplace_hint(readings.end(), rows.text(1), value_of_row(database.file(), rows.text(2), rows.number(3), rows.text(4)));
        }
        return results;
    }
};

bool Night::has_readings() const {
    return std::ranges::any_of(cells, [](const NightCell& cell) { return !cell.readings->empty(); });
}

const NightCell* Night::cell(const std::string& name, std::size_t likely) const {
    if (likely < cells.size() && cells[likely].name == name)
        return &cells[likely];
    const auto found = std::ranges::find(cells, name, &NightCell::name);
    return found == cells.end() ? nullptr : &*found;
}

History::History(const std::filesystem::path& file, For what)
    : tables_(std::make_unique<Tables>(file, what == For::reading ? Database::For::reading : Database::For::writing)) {
    if (what == For::reading && tables_->database.whole_of("PRAGMA user_version") < static_cast<std::int64_t>(steps.size()) &&
        tables_->database.whole_of("PRAGMA application_id") == history_mark) {
        Database old(file, Database::For::writing);
        migrate(old, history_mark, steps);
    }
    migrate(tables_->database, history_mark, steps);
}

History::~History() = default;

std::string History::journal() const { return tables_->database.text_of("PRAGMA journal_mode"); }

History::Added History::add(const Night& night) {
    Database& database = tables_->database;
    Transaction transaction(database);
    Statement same(database, "SELECT number FROM nights WHERE study = ?1 AND played_utc = ?2 AND folder = ?3");
    std::optional<std::int64_t> gone_on_with; ///< with cells that failed, and may be there now
    if (same.bind(1, night.study).bind(2, night.played_utc).bind(3, night.folder).step()) {
        gone_on_with = same.whole(0);
        Statement failed(database, "SELECT count(*) FROM cells WHERE night = ?1 AND failed <> ''");
        failed.bind(1, *gone_on_with).step();
        if (failed.whole(0) <= std::ranges::count_if(night.cells, [](const NightCell& cell) { return !cell.failed.empty(); }))
            return {*gone_on_with, false};
        Statement(database, "DELETE FROM cells WHERE night = ?1").bind(1, *gone_on_with).run();
    }
    std::string decide;
    for (const std::string& reading : night.decide)
        decide += reading + "\n";
    if (!gone_on_with)
        Statement(database,
                  "INSERT INTO nights (study, played_utc, folder, accepted, note, machine, decide) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)")
            .bind(1, night.study)
            .bind(2, night.played_utc)
            .bind(3, night.folder)
            .bind(4, std::int64_t{night.accepted})
            .bind(5, night.note)
            .bind(6, tables_->set_of(night.machine))
            .bind(7, decide)
            .run();
    const std::int64_t number = gone_on_with.value_or(database.last_row());
    Statement row(database, "INSERT INTO cells VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12)");
    std::int64_t place = 0;
    for (const NightCell& cell : night.cells) {
        row.bind(1, number).bind(2, place++).bind(3, cell.name).bind(4, cell.drive).bind(5, cell.lamp).bind(6, cell.technique);
        row.bind(7, cell.condition)
            .bind(8, cell.failed)
            .bind(9, tables_->set_of(*cell.inputs))
            .bind(10, tables_->result_of(*cell.readings));
        if (cell.with_earlier_inputs)
            row.bind(11, tables_->result_of(*cell.with_earlier_inputs));
        else
            row.bind_null(11);
        row.bind(12, cell.frame_s).run();
    }
    transaction.commit();
    return {number, true};
}

void History::accept(std::int64_t number, const std::string& note) {
    Transaction transaction(tables_->database);
    tables_->refuse_unknown(number);
    Statement(tables_->database, "UPDATE nights SET accepted = 1, note = ?2 WHERE number = ?1").bind(1, number).bind(2, note).run();
    transaction.commit();
}

void History::withdraw(std::int64_t number) {
    Transaction transaction(tables_->database);
    tables_->refuse_unknown(number);
    Statement(tables_->database, "UPDATE nights SET accepted = 0, note = '' WHERE number = ?1").bind(1, number).run();
    transaction.commit();
}

std::vector<Night> History::nights(const std::string& study) const {
    Database& database = tables_->database;
    database.run("BEGIN"); // what others add meanwhile is not seen in part
    const auto sets = tables_->all_sets();
    const auto results = tables_->all_results();
    const auto known = [&](const auto& all, std::int64_t number) {
        const auto found = all.find(number);
        if (found == all.end())
            throw InputError({database.file(), 0, 0, {}}, fmt::format("is damaged: row {} is missing", number),
                             "a file that `fernlicht history add` wrote");
        return found->second;
    };
    std::vector<Night> nights;
    std::map<std::int64_t, std::size_t> place_of;
    Statement heads(database, "SELECT number, study, played_utc, folder, accepted, note, machine, decide FROM nights "
                              "WHERE ?1 = '' OR study = ?1 ORDER BY number");
    heads.bind(1, study);
    while (heads.step()) {
        place_of[heads.whole(0)] = nights.size();
        Night& night = nights.emplace_back(Night{heads.whole(0),
                                                 heads.text(1),
                                                 heads.text(2),
                                                 heads.text(3),
                                                 heads.whole(4) != 0,
                                                 heads.text(5),
                                                 *known(sets, heads.whole(6)),
                                                 {},
                                                 {}});
        const std::string decide = heads.text(7);
        for (std::size_t at = 0, end = 0; (end = decide.find('\n', at)) != std::string::npos; at = end + 1)
            night.decide.push_back(decide.substr(at, end - at));
    }
    Statement rows(database,
                   "SELECT night, name, drive, lamp, technique, condition, failed, input_set, result, result_with_earlier_inputs, "
                   "frame_s FROM cells ORDER BY night, place");
    while (rows.step())
        if (const auto at = place_of.find(rows.whole(0)); at != place_of.end()) {
            NightCell cell{rows.text(1),
                           rows.text(2),
                           rows.text(3),
                           rows.text(4),
                           rows.text(5),
                           rows.text(6),
                           known(sets, rows.whole(7)),
                           known(results, rows.whole(8)),
                           nullptr,
                           rows.number(10)};
            if (!rows.is_null(9))
                cell.with_earlier_inputs = known(results, rows.whole(9));
            nights[at->second].cells.push_back(std::move(cell));
        }
    database.run("COMMIT");
    return nights;
}

History::Pruned History::prune(std::optional<std::size_t> keep, const std::string& before, bool dry) {
    Database& database = tables_->database;
    std::vector<Night> all = nights();
    std::map<std::string, std::size_t> newer;
    Pruned pruned;
    for (auto night = all.rbegin(); night != all.rend(); ++night) {
        const bool stays = keep ? newer[night->study]++ < *keep : night->date() >= before;
        if (stays)
            continue;
        if (night->accepted) {
            ++pruned.kept_accepted;
            continue;
        }
        night->cells.clear();
        pruned.nights.insert(pruned.nights.begin(), std::move(*night));
    }
    if (dry || pruned.nights.empty())
        return pruned;
    Transaction transaction(database);
    for (const Night& night : pruned.nights) {
        Statement(database, "DELETE FROM nights WHERE number = ?1 AND accepted = 0").bind(1, night.number).run(); // by another meanwhile
        Statement(database, "DELETE FROM cells WHERE night = ?1 AND night NOT IN (SELECT number FROM nights)").bind(1, night.number).run();
    }
    database.run("DELETE FROM results WHERE number NOT IN (SELECT result FROM cells UNION SELECT result_with_earlier_inputs FROM cells "
                 "WHERE result_with_earlier_inputs IS NOT NULL);"
                 "DELETE FROM readings WHERE result NOT IN (SELECT number FROM results);"
                 "DELETE FROM input_sets WHERE number NOT IN (SELECT input_set FROM cells UNION SELECT machine FROM nights);"
                 "DELETE FROM inputs WHERE input_set NOT IN (SELECT number FROM input_sets)");
    transaction.commit();
    database.run("VACUUM");
    return pruned;
}

std::filesystem::path default_history_file() {
    const char *const data = std::getenv("XDG_DATA_HOME"), *const home = std::getenv("HOME");
    const std::filesystem::path below = "fernlicht/history.db";
    if (data && *data == '/') // others are to be ignored, says the XDG specification
        return data / below;
    return home && *home ? std::filesystem::path(home) / ".local/share" / below : std::filesystem::path();
}

std::span<const char* const> history_steps() { return steps; }

} // namespace fernlicht
