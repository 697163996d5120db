#include "scenarios/openscenario/osc_node.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <vector>

namespace fernlicht::osc {
namespace {

constexpr int max_depth = 64;

bool starts_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool in_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::string name_at(std::string_view text, std::size_t at) {
    std::size_t end = at;
    while (end < text.size() && in_name(text[end]))
        ++end;
    return std::string(text.substr(at, end - at));
}

std::string parameter(const std::string& name, const Scope& scope) {
    if (auto value = scope.find(name))
        return *value;
    throw std::invalid_argument(fmt::format("unknown parameter '{}'", printable(name)));
}

struct Value {
    std::optional<double> number;
    std::string text; ///< when it is no number

    std::string written() const { return number ? fmt::format("{}", *number) : text; }
};

Value value_of(const std::string& text) {
    if (text == "pi") // not of the standard, but of its users
        return {pi, {}};
    if (text == "true")
        return {1.0, {}};
    if (text == "false")
        return {0.0, {}};
    return {to_number(text), text};
}

double function(const std::string& name, const std::vector<double>& given) {
    const auto one = [&] {
        if (given.size() != 1)
            throw std::invalid_argument(fmt::format("{} takes one value, found {}", name, given.size()));
        return given[0];
    };
    if (name == "pow" || name == "min" || name == "max") {
        if (given.size() != 2)
            throw std::invalid_argument(fmt::format("{} takes two values, found {}", name, given.size()));
        return name == "pow" ? std::pow(given[0], given[1]) : name == "min" ? std::min(given[0], given[1]) : std::max(given[0], given[1]);
    }
    if (name == "sign")
        return one() > 0.0 ? 1.0 : one() < 0.0 ? -1.0 : 0.0;
    struct Named {
        const char* name;
        double (*of)(double);
    };
    static constexpr Named known[] = {{"sqrt", std::sqrt}, {"abs", std::fabs},  {"round", std::round}, {"floor", std::floor},
                                      {"ceil", std::ceil}, {"sin", std::sin},   {"cos", std::cos},     {"tan", std::tan},
                                      {"asin", std::asin}, {"acos", std::acos}, {"atan", std::atan}};
    for (const Named& candidate : known)
        if (name == candidate.name)
            return candidate.of(one());
    throw std::invalid_argument(fmt::format("unknown function '{}'", printable(name)));
}

/// Reads by precedence: or, and, comparison, sum, product, sign.
class Parser {
  public:
    Parser(std::string_view text, const Scope& scope) : text_(text), scope_(scope) {}

    Value whole() {
        Value value = either();
        blanks();
        if (at_ < text_.size())
            throw std::invalid_argument(fmt::format("found '{}' behind the expression", printable(std::string(text_.substr(at_)))));
        return value;
    }

  private:
    void blanks() {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0)
            ++at_;
    }
    bool take(std::string_view sign) {
        blanks();
        if (!text_.substr(at_).starts_with(sign))
            return false;
        if (starts_name(sign[0]) && at_ + sign.size() < text_.size() && in_name(text_[at_ + sign.size()]))
            return false;
        at_ += sign.size();
        return true;
    }
    static double number(const Value& value) {
        if (!value.number)
            throw std::invalid_argument(fmt::format("found '{}', expected a number", printable(value.text)));
        return *value.number;
    }
    static Value truth(bool is) { return {is ? 1.0 : 0.0, {}}; }

    Value either() {
        Value left = both();
        while (take("or")) {
            const Value right = both();
            left = truth(number(left) != 0.0 || number(right) != 0.0);
        }
        return left;
    }
    Value both() {
        Value left = compared();
        while (take("and")) {
            const Value right = compared();
            left = truth(number(left) != 0.0 && number(right) != 0.0);
        }
        return left;
    }
    Value compared() {
        Value left = sum();
        for (;;) {
            if (take("=="))
                left = truth(left.written() == sum().written());
            else if (take("!="))
                left = truth(left.written() != sum().written());
            else if (take("<="))
                left = truth(number(left) <= number(sum()));
            else if (take(">="))
                left = truth(number(left) >= number(sum()));
            else if (take("<"))
                left = truth(number(left) < number(sum()));
            else if (take(">"))
                left = truth(number(left) > number(sum()));
            else
                return left;
        }
    }
    /// Texts may be joined by `+`.
    Value sum() {
        Value left = product();
        for (;;) {
            if (take("+")) {
                const Value right = product();
                left = left.number && right.number ? Value{*left.number + *right.number, {}} : Value{{}, left.written() + right.written()};
            } else if (take("-")) {
                left = {number(left) - number(product()), {}};
            } else {
                return left;
            }
        }
    }
    Value product() {
        Value left = signed_value();
        for (;;) {
            if (take("*")) {
                left = {number(left) * number(signed_value()), {}};
            } else if (take("/") || take("%")) {
                const bool ratio = text_[at_ - 1] == '/';
                const double by = number(signed_value());
                if (by == 0.0)
                    throw std::invalid_argument("a division by zero");
                left = {ratio ? number(left) / by : std::fmod(number(left), by), {}};
            } else {
                return left;
            }
        }
    }
    Value signed_value() {
        if (++depth_ > max_depth)
            throw std::invalid_argument("brackets nested too deeply");
        Value value = take("-") ? Value{-number(signed_value()), {}} : take("not") ? truth(number(signed_value()) == 0.0) : single();
        --depth_;
        return value;
    }
    Value single() {
        blanks();
        if (at_ >= text_.size())
            throw std::invalid_argument("the expression ends where a value is expected");
        if (take("(")) {
            Value value = either();
            if (!take(")"))
                throw std::invalid_argument("a bracket is not closed");
            return value;
        }
        if (text_[at_] == '$') {
            const std::string name = name_at(text_, at_ + 1);
            at_ += 1 + name.size();
            return value_of(parameter(name, scope_));
        }
        if (text_[at_] == '\'' || text_[at_] == '"')
            return quoted();
        return starts_name(text_[at_]) ? word() : literal();
    }
    Value quoted() {
        const std::size_t end = text_.find(text_[at_], at_ + 1);
        if (end == std::string_view::npos)
            throw std::invalid_argument("a quotation mark is not closed");
        Value value{{}, std::string(text_.substr(at_ + 1, end - at_ - 1))};
        at_ = end + 1;
        return value;
    }
    Value word() {
        std::string name = name_at(text_, at_);
        at_ += name.size();
        if (!take("(")) {
            while (at_ + 1 < text_.size() && text_[at_] == ' ' && starts_name(text_[at_ + 1])) { // a text of several words
                const std::string more = name_at(text_, at_ + 1);
                if (more == "and" || more == "or")
                    break;
                name += ' ' + more;
                at_ += 1 + more.size();
            }
            return value_of(name);
        }
        std::vector<double> given;
        if (!take(")")) {
            do {
                given.push_back(number(either()));
            } while (take(","));
            if (!take(")"))
                throw std::invalid_argument("a bracket is not closed");
        }
        return {function(name, given), {}};
    }
    Value literal() {
        std::size_t end = at_;
        while (end < text_.size() && (in_name(text_[end]) || text_[end] == '.' ||
                                      ((text_[end] == '-' || text_[end] == '+') && end > at_ && std::tolower(text_[end - 1]) == 'e')))
            ++end;
        const std::string found(text_.substr(at_, std::max<std::size_t>(end - at_, 1)));
        const auto number = to_number(found);
        if (!number)
            throw std::invalid_argument(fmt::format("found '{}', expected a number", printable(found)));
        at_ = end;
        return {number, {}};
    }

    std::string_view text_;
    const Scope& scope_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

/// The value of one expression without its `${` and `}`.
std::string evaluate(std::string_view expression, const Scope& scope) {
    const Value value = Parser(expression, scope).whole();
    if (value.number && !std::isfinite(*value.number))
        throw std::invalid_argument("the expression has no finite value");
    return value.written();
}

} // namespace

std::string resolve(std::string_view text, const Scope& scope) {
    constexpr std::size_t longest = 65536; // parameters of parameters can double at each step
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        if (out.size() > longest)
            break;
        if (text[at] == '\\' && at + 1 < text.size() && text[at + 1] == '$') {
            out += '$';
            at += 2;
        } else if (text[at] != '$' || at + 1 == text.size()) {
            out += text[at++];
        } else if (text[at + 1] == '{') {
            const std::size_t end = text.find('}', at);
            if (end == std::string_view::npos)
                throw std::invalid_argument("an expression is not closed by '}'");
            out += evaluate(text.substr(at + 2, end - at - 2), scope);
            at = end + 1;
        } else {
            const std::string name = name_at(text, at + 1);
            out += parameter(name, scope);
            at += 1 + name.size();
        }
    }
    if (out.size() > longest)
        throw std::invalid_argument(fmt::format("its parameters give a text of more than {} bytes", longest));
    return out;
}

} // namespace fernlicht::osc
