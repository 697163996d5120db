// A file in JSON with one struct in it, made by json_file() of described_json.h.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace fernlicht {

template <class Struct> struct JsonFile {
    std::function<std::string(const Struct&)> text;
    std::function<Struct(const std::filesystem::path&)> read; ///< Throws InputError for what is no such file, with the place in it.
    std::function<std::string()> schema;
};

} // namespace fernlicht
