// Lines and words of a text mesh file, with the line number for messages (internal to engine/mesh).
#pragma once

#include "engine/mesh/mesh_source.h"

namespace anvil {

/// Goes through the text from `begin` on, line by line. Lines end with LF, CR LF, or (in files without any
/// LF) CR.
class TextScanner {
  public:
    struct Style {
        char comment = '\0';       ///< the rest of the line after it is left out
        bool continuation = false; ///< a backslash at the end joins the next line
    };

    TextScanner(const MeshSource& source, size_t begin, Style style);

    /// Moves to the next line that has a word; false at the end of the file.
    bool next_line();
    /// Whether the line has no further word.
    bool line_done();
    /// The next word of the line; empty if there is none.
    std::string_view word();
    /// The same, without moving on.
    std::string_view peek_word();
    /// The next word, on whichever line; empty at the end of the file.
    std::string_view word_anywhere();
    /// The rest of the line without blanks around it.
    std::string_view rest();
    /// The next number. Fails if there is none; `what` names what is wanted.
    double number(const char* what);
    /// The same; fails also if it is not finite or too large for a coordinate.
    double coordinate(const char* what);
    /// The same for counts and indices; fails if it is not an integer.
    long long integer(const char* what);

    size_t line() const { return line_; }
    /// Bytes from here to the end of the file.
    size_t remaining() const {
        return static_cast<size_t>(source_.text.data() + source_.text.size() - next_);
    }
    /// Bytes from here to the end of the line.
    size_t line_remaining() const { return static_cast<size_t>(end_ - at_); }
    [[noreturn]] void fail(const std::string& cause, const std::string& mend) const {
        source_.fail_at_line(line_, cause, mend);
    }

  private:
    void take_line();
    void join_continued();
    void cut_comment();
    void skip_blanks();
    [[noreturn]] void fail_number(const char* what);

    const MeshSource& source_;
    Style style_;
    char separator_ = '\n';
    const char* next_;          ///< start of the next line in the file
    const char* at_ = nullptr;  ///< where the line is read
    const char* end_ = nullptr; ///< its end
    size_t line_ = 0;           ///< of the line's first byte
    size_t lines_taken_ = 0;
    std::string joined_;
};

} // namespace anvil
