// A JSON value with its place in the file, so that every complaint names file, key and what was found.
#pragma once

#include "engine/core/types.h"

#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace anvil {

/// Parses a whole JSON text. @throws InputError for syntax (line and column), numbers beyond double, keys
/// that occur twice in an object and nesting deeper than 100.
nlohmann::json parse_json(const std::string& text, const std::string& file);

/// The one of `known` with the smallest edit distance to `word`; empty if none is known.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

/// A view: the document and the file name must outlive it. All reading members throw InputError
/// "FILE: PATH: found ...; must ...".
class JsonReader {
  public:
    JsonReader(const nlohmann::json& document, const std::string& file) : value_(&document), file_(&file) {}

    [[noreturn]] void fail(const std::string& message) const;
    /// "found X; MUST".
    [[noreturn]] void fail_found(const std::string& must) const;
    /// Fails with what another stage said of this value.
    [[noreturn]] void fail_inside(const std::string& message) const;

    bool is_string() const;
    bool is_list() const;
    bool is_object() const;
    bool has(const std::string& key) const;

    /// This must be an object without other keys than `known`.
    void check_keys(const std::vector<std::string>& known) const;

    JsonReader required(const std::string& key) const;
    std::optional<JsonReader> find(const std::string& key) const;
    std::vector<JsonReader> items() const;

    double number() const;
    double positive() const;
    double within(double low, double high) const;
    uint32_t whole(uint32_t low, uint32_t high) const;
    uint32_t index() const { return whole(0, no_index - 1); }
    bool boolean() const;
    std::string text() const;
    Vec3 vector() const;
    Vec3 direction() const; ///< not zero

    /// One of several words.
    template <class Value>
    Value word(std::initializer_list<std::pair<const char*, Value>> known) const {
        std::vector<std::string> names;
        for (const auto& [name, value] : known) {
            names.emplace_back(name);
        }
        return (known.begin() + word_index(names))->second;
    }

  private:
    JsonReader child(const std::string& key) const;
    size_t word_index(const std::vector<std::string>& known) const;
    std::string found() const;

    const nlohmann::json* value_;
    const std::string* file_;
    std::string path_;
};

} // namespace anvil
