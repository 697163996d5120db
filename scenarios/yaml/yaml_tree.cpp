#include "scenarios/yaml/yaml_tree.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"
#include "scenarios/values/pose.h"
#include "scenarios/values/refusals.h"

#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

namespace fernlicht {
namespace {

constexpr std::size_t deepest = 32;
constexpr std::size_t max_yaml_values = 100'000;

std::size_t count_values(const YamlValue& value) {
    std::size_t count = 1;
    for (const YamlValue& item : value.items)
        count += count_values(item);
    for (const YamlMember& member : value.members)
        count += count_values(member.value);
    return count;
}

/// Builds the tree from the parser's events.
class TreeBuilder : public YAML::EventHandler {
  public:
    explicit TreeBuilder(const std::filesystem::path& file) : file_(file) {}
    YamlValue take_root() { return std::move(root_); }

    void OnDocumentStart(const YAML::Mark&) override {}
    void OnDocumentEnd() override {}

    void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { add(placed(mark, YamlValue::Kind::null), anchor, mark); }

    void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
        const auto known = anchors_.find(anchor);
        if (known == anchors_.end())
            refuse(mark, "an alias inside the value that it names", "an alias of a value that is complete");
        values_ += count_values(known->second) - 1;
        add(known->second, 0, mark);
    }

    void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, const std::string& text) override {
        YamlValue value = placed(mark, YamlValue::Kind::scalar);
        value.text = text;
        value.quoted = tag == "!";
        add(std::move(value), anchor, mark);
    }

    void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor, YAML::EmitterStyle::value) override {
        open(mark, YamlValue::Kind::list, anchor);
    }
    void OnSequenceEnd() override { close(); }

    void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor, YAML::EmitterStyle::value) override {
        open(mark, YamlValue::Kind::map, anchor);
    }
    void OnMapEnd() override { close(); }

  private:
    struct Open {
        YamlValue value;
        YAML::anchor_t anchor = 0;
        std::optional<YamlMember> member; ///< map only: a key that waits for its value
        std::set<std::string> keys;
    };

    [[noreturn]] void refuse(const YAML::Mark& mark, const std::string& found, const std::string& expected) const {
        throw InputError({file_, static_cast<std::size_t>(mark.line + 1), static_cast<std::size_t>(mark.column + 1), {}}, "found " + found,
                         expected);
    }

    static YamlValue placed(const YAML::Mark& mark, YamlValue::Kind kind) {
        YamlValue value;
        value.kind = kind;
        if (!mark.is_null()) {
            value.line = static_cast<std::size_t>(mark.line + 1);
            value.column = static_cast<std::size_t>(mark.column + 1);
        }
        return value;
    }

    void open(const YAML::Mark& mark, YamlValue::Kind kind, YAML::anchor_t anchor) {
        if (open_.size() >= deepest)
            refuse(mark, fmt::format("more than {} levels of nesting", deepest), "a flatter file");
        if (!open_.empty() && open_.back().value.kind == YamlValue::Kind::map && !open_.back().member)
            refuse(mark, "a list or map as a key", "plain text");
        open_.push_back({placed(mark, kind), anchor, std::nullopt, {}});
    }

    void close() {
        Open done = std::move(open_.back());
        open_.pop_back();
        YAML::Mark mark;
        mark.line = static_cast<int>(done.value.line - 1);
        mark.column = static_cast<int>(done.value.column - 1);
        add(std::move(done.value), done.anchor, mark);
    }

    void add(YamlValue value, YAML::anchor_t anchor, const YAML::Mark& mark) {
        if (++values_ > max_yaml_values)
            refuse(mark, fmt::format("more than {} values", max_yaml_values), "a smaller file");
        if (anchor != 0)
            anchors_[anchor] = value;
        if (open_.empty()) {
            root_ = std::move(value);
            return;
        }
        Open& parent = open_.back();
        if (parent.value.kind == YamlValue::Kind::list) {
            parent.value.items.push_back(std::move(value));
        } else if (parent.member) {
            // Nothing after the key: the parser places it at what comes next, lines below.
            if (value.kind == YamlValue::Kind::null && value.line != parent.member->line) {
                value.line = parent.member->line;
                value.column = parent.member->column;
            }
            parent.member->value = std::move(value);
            parent.value.members.push_back(std::move(*parent.member));
            parent.member.reset();
        } else {
            begin_member(parent, value, mark);
        }
    }

    void begin_member(Open& parent, const YamlValue& key, const YAML::Mark& mark) const {
        if (key.kind != YamlValue::Kind::scalar)
            refuse(mark, "a key without text", "plain text");
        if (!parent.keys.insert(key.text).second)
            refuse_and_go_on(
                {{file_, key.line, key.column, {}}, fmt::format("found the key '{}' a second time", printable(key.text)), "each key once"});
        parent.member = YamlMember{key.text, key.line, key.column, {}};
    }

    const std::filesystem::path& file_;
    YamlValue root_;
    std::vector<Open> open_;
    std::map<YAML::anchor_t, YamlValue> anchors_;
    std::size_t values_ = 0;
};

/// The first line that a tab indents; 0: none.
std::size_t tabbed_line(const std::string& content) {
    std::istringstream lines(content);
    std::size_t number = 1;
    for (std::string line; std::getline(lines, line); ++number)
        if (const std::size_t first = line.find_first_not_of(' '); first != std::string::npos && line[first] == '\t')
            return number;
    return 0;
}

} // namespace

YamlValue parse_yaml(const std::string& content, const std::filesystem::path& file) {
    // As it is, or each byte made a character before it came here, the mark among them.
    if (is_utf16(content) || content.starts_with("\u00ff\u00fe") || content.starts_with("\u00fe\u00ff"))
        throw InputError({file, 0, 0, {}}, "is encoded in UTF-16: save it as UTF-8");
    if (const std::size_t at = content.find('\0'); at != std::string::npos)
        throw InputError({file, 0, 0, {}}, fmt::format("found a zero byte at byte {}", at), "YAML text");
    TreeBuilder builder(file);
    try {
        std::istringstream stream(content);
        YAML::Parser parser(stream);
        if (!parser.HandleNextDocument(builder))
            throw InputError({file, 0, 0, {}}, "found no content", "a YAML map");
        YamlValue root = builder.take_root();
        TreeBuilder rest(file);
        if (parser.HandleNextDocument(rest))
            throw InputError({file, rest.take_root().line, 0, {}}, "found a second YAML document", "one");
        return root;
    } catch (const YAML::Exception& error) {
        if (const std::size_t line = tabbed_line(content); line > 0)
            throw InputError({file, line, 1, {}}, "found a tab before the text", "blanks: YAML indents by them alone");
        const bool placed = !error.mark.is_null();
        throw InputError({file,
                          placed ? static_cast<std::size_t>(error.mark.line + 1) : 0,
                          placed ? static_cast<std::size_t>(error.mark.column + 1) : 0,
                          {}},
                         "is not YAML: " + printable(error.msg, 200));
    }
}

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            out += fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
        else
            out += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
    return out + '"';
}

std::string angle_entry(std::string_view key, double angle_rad) {
    const double middle = degrees(angle_rad);
    for (const double candidate : {middle, std::nextafter(middle, -HUGE_VAL), std::nextafter(middle, HUGE_VAL)})
        if (radians(candidate) == angle_rad)
            return fmt::format("{}_deg: {}", key, candidate);
    return fmt::format("{}_rad: {}", key, angle_rad);
}

} // namespace fernlicht
