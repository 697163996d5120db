#include "runner/can/frame_json.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

[[noreturn]] void refuse_json(const InputError::Where& where, const std::string& key, const std::string& found,
                              const std::string& expected) {
    throw InputError({where.file, where.line, 0, key}, "found " + printable(found), expected);
}

// A JSON value whose numbers keep their text.
struct Token {
    enum class Kind { number, text, truth, null } kind = Kind::null;
    std::string text; ///< "true", "false" for truth
};

// Takes one object with one level of objects and lists within it, as they come.
class FrameReader : public nlohmann::json_sax<nlohmann::json> {
  public:
    FrameReader(FrameJson& frame, const InputError::Where& where) : frame_(frame), where_(where) {}

    bool null() override { return take({Token::Kind::null, "null"}); }
    bool boolean(bool value) override { return take({Token::Kind::truth, value ? "true" : "false"}); }
    bool number_integer(number_integer_t value) override { return take({Token::Kind::number, fmt::format("{}", value)}); }
    bool number_unsigned(number_unsigned_t value) override { return take({Token::Kind::number, fmt::format("{}", value)}); }
    bool number_float(number_float_t, const string_t& text) override { return take({Token::Kind::number, text}); }
    bool string(string_t& text) override { return take({Token::Kind::text, text}); }
    bool binary(binary_t&) override { return false; }
    bool start_object(std::size_t) override {
        if (++depth_ == 2)
            section_ = key_;
        frame_.has_signals |= depth_ == 2 && section_ == "signals";
        return depth_ <= 2 && lists_ == 0 ? true : too_deep();
    }
    bool end_object() override {
        --depth_;
        section_.clear();
        return true;
    }
    bool start_array(std::size_t) override { return depth_ == 0 || ++lists_ > 1 ? too_deep() : true; }
    bool end_array() override {
        --lists_;
        return true;
    }
    bool key(string_t& text) override {
        key_ = text;
        return true;
    }
    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception&) override {
        throw InputError({where_.file, where_.line, position, {}}, "found what is no JSON",
                         "one object a line, as `fernlicht can decode --json` writes it");
    }

  private:
    bool too_deep() {
        refuse_json(where_, key_, depth_ == 0 ? "a list" : "an object or a list within", "an object with frame and signals");
    }
    bool take(const Token& token);
    void take_frame_key(const Token& token);
    std::uint64_t whole(const Token& token, std::uint64_t greatest) const;
    bool truth(const Token& token) const;
    const std::string& text(const Token& token) const;
    void take_time(const Token& token);
    void take_id(const std::string& text);
    void take_data(const std::string& text);

    FrameJson& frame_;
    const InputError::Where& where_;
    std::string key_, section_;
    int depth_ = 0, lists_ = 0;
};

bool FrameReader::take(const Token& token) {
    if (depth_ == 0)
        refuse_json(where_, {}, token.text, "an object with frame and signals");
    if (lists_ > 0)
        return true;
    if (depth_ == 1)
        take_frame_key(token);
    else if (section_ == "signals" && token.kind != Token::Kind::null) {
        if (token.kind == Token::Kind::truth)
            frame_.signals.emplace_back(key_, token.text == "true" ? "1" : "0");
        else
            frame_.signals.emplace_back(key_, token.text);
    }
    return true;
}

std::uint64_t FrameReader::whole(const Token& token, std::uint64_t greatest) const {
    std::uint64_t value = 0;
    const char *begin = token.text.data(), *end = begin + token.text.size();
    if (const auto [stop, error] = std::from_chars(begin, end, value);
        token.kind != Token::Kind::number || error != std::errc{} || stop != end || value > greatest)
        refuse_json(where_, key_, "'" + token.text + "'", fmt::format("a whole number up to {}", greatest));
    return value;
}

bool FrameReader::truth(const Token& token) const {
    if (token.kind != Token::Kind::truth)
        refuse_json(where_, key_, "'" + token.text + "'", "true or false");
    return token.text == "true";
}

const std::string& FrameReader::text(const Token& token) const {
    if (token.kind != Token::Kind::text)
        refuse_json(where_, key_, token.text, "a text");
    return token.text;
}

void FrameReader::take_time(const Token& token) {
    const std::size_t point = std::min(token.text.find('.'), token.text.size());
    const std::string seconds = token.text.substr(0, point);
    std::string fraction = point < token.text.size() ? token.text.substr(point + 1) : "";
    std::int64_t whole_seconds = 0, ns = 0;
    const auto [stop, error] = std::from_chars(seconds.data(), seconds.data() + seconds.size(), whole_seconds);
    const bool digits = fraction.find_first_not_of("0123456789") == std::string::npos && fraction.size() <= 9;
    if (token.kind != Token::Kind::number || error != std::errc{} || stop != seconds.data() + seconds.size() || !digits ||
        whole_seconds < 0 || whole_seconds > 9'000'000'000)
        refuse_json(where_, key_, "'" + token.text + "'", "seconds from 0 up, with up to nine digits behind the point");
    frame_.line.style.stamp_digits = fraction.size() > 6 ? 9 : 6;
    fraction.resize(9, '0');
    std::from_chars(fraction.data(), fraction.data() + 9, ns);
    frame_.line.frame.time_ns = whole_seconds * 1'000'000'000 + ns;
    frame_.has_time = true;
}

void FrameReader::take_id(const std::string& id) {
    CanFrame& frame = frame_.line.frame;
    const auto [stop, error] = std::from_chars(id.data(), id.data() + id.size(), frame.id, 16);
    const bool extended = id.size() == 8;
    if (error != std::errc{} || stop != id.data() + id.size() || (!extended && (id.size() > 3 || frame.id > 0x7FF)) ||
        frame.id > 0x3FFFFFFF)
        refuse_json(where_, key_, "'" + id + "'", "3 hexadecimal digits up to \"7FF\", or 8 for extended identifiers");
    if ((frame.id & 0x20000000U) != 0) {
        frame.id &= 0x1FFFFFFFU;
        frame.error = true;
    } else
        frame.extended = extended;
    frame_.has_id = true;
}

void FrameReader::take_data(const std::string& data) {
    CanFrame& frame = frame_.line.frame;
    const bool digits = data.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
    if (!digits || data.size() % 2 != 0 || data.size() > 128)
        refuse_json(where_, key_, "'" + data + "'", "two hexadecimal digits for each of up to 64 bytes");
    frame.length = static_cast<std::uint8_t>(data.size() / 2);
    for (std::size_t i = 0; i < data.size() / 2; ++i)
        std::from_chars(data.data() + 2 * i, data.data() + 2 * i + 2, frame.data[i], 16);
    frame_.has_data = true;
}

void FrameReader::take_frame_key(const Token& token) {
    CanFrame& frame = frame_.line.frame;
    if (key_ == "time")
        take_time(token);
    else if (key_ == "channel")
        frame.channel = text(token);
    else if (key_ == "id")
        take_id(text(token));
    else if (key_ == "data")
        take_data(text(token));
    else if (key_ == "message")
        frame_.message = text(token);
    else if (key_ == "fd")
        frame.fd = truth(token);
    else if (key_ == "brs")
        frame.bit_rate_switch = truth(token);
    else if (key_ == "esi")
        frame.error_state_indicator = truth(token);
    else if (key_ == "remote")
        frame.remote = truth(token);
    else if (key_ == "error")
        frame.error = truth(token);
    else if (key_ == "length")
        frame.length = static_cast<std::uint8_t>(whole(token, 64));
    else if (key_ == "dlc")
        frame.raw_dlc = static_cast<std::uint8_t>(whole(token, 15));
    else if (key_ == "more_fd_flags")
        frame_.line.style.more_fd_flags = static_cast<std::uint8_t>(whole(token, 15));
    else if (key_ == "sent")
        frame_.line.style.sent = truth(token);
    else if (key_ == "dropped")
        frame_.is_frame = false;
    // other keys are those of whoever stood between
}

} // namespace

FrameJson parse_frame_json(std::string_view text, const InputError::Where& where) {
    FrameJson frame;
    FrameReader reader(frame, where);
    nlohmann::json::sax_parse(text, &reader);
    return frame;
}

} // namespace fernlicht
