#include "engine/mesh/text_scanner.h"

#include "engine/core/decimal.h"

#include <cstring>

namespace anvil {

namespace {

bool blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

constexpr const char* mend_number = "write a decimal number with a point there";

} // namespace

TextScanner::TextScanner(const MeshSource& source, size_t begin, Style style)
    : source_(source), style_(style), next_(source.text.data() + begin) {
    const std::string_view text = source.text;
    if (text.find('\n') == std::string_view::npos && text.find('\r') != std::string_view::npos) {
        separator_ = '\r';
    }
    lines_taken_ = static_cast<size_t>(
        std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(begin), separator_));
}

void TextScanner::take_line() {
    const char* file_end = source_.text.data() + source_.text.size();
    const auto left = static_cast<size_t>(file_end - next_);
    const auto* stop = static_cast<const char*>(std::memchr(next_, separator_, left));
    at_ = next_;
    end_ = stop != nullptr ? stop : file_end;
    next_ = stop != nullptr ? stop + 1 : file_end;
    ++lines_taken_;
}

void TextScanner::cut_comment() {
    if (style_.comment != '\0' && end_ != at_) {
        const void* mark = std::memchr(at_, style_.comment, static_cast<size_t>(end_ - at_));
        end_ = mark != nullptr ? static_cast<const char*>(mark) : end_;
    }
}

void TextScanner::join_continued() {
    const auto continued = [&] {
        while (end_ != at_ && blank(end_[-1])) {
            --end_;
        }
        return end_ != at_ && end_[-1] == '\\';
    };
    if (!continued()) {
        return;
    }
    joined_.clear();
    bool more = true;
    while (more) {
        joined_.append(at_, end_ - 1);
        joined_ += ' ';
        take_line();
        cut_comment();
        more = continued() && remaining() > 0;
    }
    joined_.append(at_, end_);
    at_ = joined_.data();
    end_ = at_ + joined_.size();
}

bool TextScanner::next_line() {
    while (remaining() > 0) {
        line_ = lines_taken_ + 1;
        take_line();
        cut_comment();
        if (style_.continuation) {
            join_continued();
        }
        if (!line_done()) {
            return true;
        }
    }
    return false;
}

void TextScanner::skip_blanks() {
    while (at_ != end_ && blank(*at_)) {
        ++at_;
    }
}

bool TextScanner::line_done() {
    skip_blanks();
    return at_ == end_;
}

std::string_view TextScanner::word() {
    skip_blanks();
    const char* begin = at_;
    while (at_ != end_ && !blank(*at_)) {
        ++at_;
    }
    return {begin, static_cast<size_t>(at_ - begin)};
}

std::string_view TextScanner::peek_word() {
    const std::string_view found = word();
    at_ -= found.size();
    return found;
}

std::string_view TextScanner::word_anywhere() {
    if (line_done() && !next_line()) {
        return {};
    }
    return word();
}

std::string_view TextScanner::rest() {
    skip_blanks();
    const char* begin = at_;
    at_ = end_;
    const char* stop = end_;
    while (stop != begin && blank(stop[-1])) {
        --stop;
    }
    return {begin, static_cast<size_t>(stop - begin)};
}

double TextScanner::number(const char* what) {
    skip_blanks();
    double value = 0;
    const char* stop = parse_number(at_, end_, value);
    if (stop == at_ || (stop != end_ && !blank(*stop))) {
        fail_number(what);
    }
    at_ = stop;
    return value;
}

double TextScanner::coordinate(const char* what) {
    skip_blanks();
    const char* begin = at_;
    const double value = number(what);
    if (!(std::abs(value) <= largest_accepted_coordinate)) {
        fail(std::string(what) + " " + std::string(begin, at_) + " is not a finite number up to 1e36",
             mend_number);
    }
    return value;
}

long long TextScanner::integer(const char* what) {
    const double value = number(what);
    if (!(std::abs(value) <= 9e15) || value != std::floor(value)) {
        std::string text;
        append_number(text, value);
        fail(std::string(what) + " " + text + " is not an integer", "write an integer there");
    }
    return static_cast<long long>(value);
}

void TextScanner::fail_number(const char* what) {
    const std::string_view found = word().substr(0, 40);
    if (found.empty()) {
        fail(std::string(what) + " is missing", "complete the line");
    }
    fail(std::string(what) + " '" + std::string(found) + "' is not a number", mend_number);
}

} // namespace anvil
