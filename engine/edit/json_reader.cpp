#include "engine/edit/json_reader.h"

#include "engine/core/error.h"
#include "engine/core/number_text.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

namespace anvil {

namespace {

using nlohmann::json;

// Levenshtein's distance, one row at a time.
size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 0; i < a.size(); ++i) {
        size_t diagonal = row[0];
        row[0] = i + 1;
        for (size_t j = 0; j < b.size(); ++j) {
            const size_t above = row[j + 1];
            row[j + 1] = std::min({above + 1, row[j] + 1, diagonal + (a[i] == b[j] ? 0 : 1)});
            diagonal = above;
        }
    }
    return row.back();
}

std::string joined(const std::vector<std::string>& words) {
    std::string result;
    for (const std::string& word : words) {
        result += (result.empty() ? "\"" : ", \"") + word + "\"";
    }
    return result;
}

bool contains(const std::vector<std::string>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

// A file may hold a key of any length; neither message nor edit distance should.
std::string shortened(std::string text) {
    constexpr size_t readable = 60;
    if (text.size() > readable) {
        text.resize(readable);
        while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xc0u) == 0x80u) {
            text.pop_back();
        }
        text += "...";
    }
    return text;
}

} // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& known) {
    std::string best;
    size_t least = std::string::npos;
    for (const std::string& candidate : known) {
        const size_t distance = edit_distance(shortened(word), candidate);
        if (distance < least) {
            least = distance;
            best = candidate;
        }
    }
    return best;
}

void JsonReader::fail(const std::string& message) const {
    throw InputError(*file_ + ": " + (path_.empty() ? "" : path_ + ": ") + message);
}

void JsonReader::fail_found(const std::string& must) const {
    fail("found " + found() + "; " + must);
}

void JsonReader::fail_inside(const std::string& message) const {
    throw InputError(*file_ + ": " + (path_.empty() ? "" : path_ + ".") + message);
}

std::string JsonReader::found() const {
    if (value_->is_object()) {
        return "an object {...}";
    }
    if (value_->is_array()) {
        const bool plain = value_->size() <= 4 && std::all_of(value_->begin(), value_->end(),
                                                              [](const json& v) { return v.is_primitive(); });
        return plain ? shortened(value_->dump()) : "a list of " + std::to_string(value_->size());
    }
    return shortened(value_->dump());
}

bool JsonReader::is_string() const {
    return value_->is_string();
}
bool JsonReader::is_list() const {
    return value_->is_array();
}
bool JsonReader::is_object() const {
    return value_->is_object();
}
bool JsonReader::has(const std::string& key) const {
    return value_->is_object() && value_->contains(key);
}

void JsonReader::check_keys(const std::vector<std::string>& known) const {
    if (!value_->is_object()) {
        fail_found("must be an object with the keys " + joined(known));
    }
    for (const auto& [key, value] : value_->items()) {
        if (!contains(known, key)) {
            child(shortened(key))
                .fail("unknown key; did you mean \"" + nearest_word(key, known) +
                      "\"? known here: " + joined(known));
        }
    }
}

JsonReader JsonReader::child(const std::string& key) const {
    JsonReader result = *this;
    result.path_ += (path_.empty() ? "" : ".") + key;
    const auto entry = value_->find(key);
    result.value_ = entry == value_->end() ? value_ : &*entry;
    return result;
}

JsonReader JsonReader::required(const std::string& key) const {
    if (!has(key)) {
        fail("the key \"" + key + "\" is missing");
    }
    return child(key);
}

std::optional<JsonReader> JsonReader::find(const std::string& key) const {
    return has(key) ? std::optional<JsonReader>(child(key)) : std::nullopt;
}

std::vector<JsonReader> JsonReader::items() const {
    if (!value_->is_array()) {
        fail_found("must be a list [...]");
    }
    std::vector<JsonReader> result(value_->size(), *this);
    for (size_t i = 0; i < result.size(); ++i) {
        result[i].value_ = &(*value_)[i];
        result[i].path_ += "[" + std::to_string(i) + "]";
    }
    return result;
}

double JsonReader::number() const {
    if (!value_->is_number()) {
        fail_found("must be a number");
    }
    return value_->get<double>();
}

double JsonReader::positive() const {
    const double x = number();
    if (!(x > 0)) {
        fail_found("must be greater than 0");
    }
    return x;
}

double JsonReader::within(double low, double high) const {
    const double x = number();
    if (!(x >= low && x <= high)) {
        fail_found("must be within [" + number_text(low) + ", " + number_text(high) + "]");
    }
    return x;
}

uint32_t JsonReader::whole(uint32_t low, uint32_t high) const {
    const double x = value_->is_number() ? value_->get<double>() : -1;
    if (!(x >= low && x <= high && x == std::floor(x))) {
        fail_found("must be a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    }
    return static_cast<uint32_t>(x);
}

bool JsonReader::boolean() const {
    if (!value_->is_boolean()) {
        fail_found("must be true or false");
    }
    return value_->get<bool>();
}

std::string JsonReader::text() const {
    if (!value_->is_string()) {
        fail_found("must be a text in quotes");
    }
    return value_->get<std::string>();
}

Vec3 JsonReader::vector() const {
    const bool good =
        value_->is_array() && value_->size() == 3 &&
        std::all_of(value_->begin(), value_->end(), [](const json& v) { return v.is_number(); });
    if (!good) {
        fail_found("must be a list of three numbers [x, y, z]");
    }
    return {(*value_)[0].get<double>(), (*value_)[1].get<double>(), (*value_)[2].get<double>()};
}

Vec3 JsonReader::direction() const {
    const Vec3 v = vector();
    if (v == Vec3(0.0)) {
        fail_found("a direction must not be zero");
    }
    return v;
}

size_t JsonReader::word_index(const std::vector<std::string>& known) const {
    const std::string word = value_->is_string() ? text() : "";
    const auto entry = std::find(known.begin(), known.end(), word);
    if (entry == known.end()) {
        fail_found("must be one of " + joined(known));
    }
    return static_cast<size_t>(entry - known.begin());
}

} // namespace anvil
