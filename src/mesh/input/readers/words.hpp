#pragma once

// Text of mesh files, word by word: shared by the readers of OBJ, PLY, OFF and STL.

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace elastolab {

inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\0'; }
inline bool is_line_end(char c) { return c == '\n' || c == '\r'; }

/// Walks through a text by words. A word ends at a blank or at the end of its line; '#' begins a comment, where the
/// format has those, that ends with the line.
class Words {
public:
    explicit Words(std::string_view text, bool has_comments) : text_(text), has_comments_(has_comments) {}

    /// The next word, on this line or a later one; empty at the end of the text.
    std::string_view next() {
        while (at_ < text_.size() && (is_line_end(text_[at_]) || at_blank_or_comment())) step();
        return take();
    }
    /// The next word of this line; empty when the line has no more.
    std::string_view next_in_line() {
        while (at_ < text_.size() && at_blank_or_comment()) step();
        return take();
    }
    /// Goes to the end of this line (the line break itself stays).
    void skip_line() {
        while (at_ < text_.size() && !is_line_end(text_[at_])) ++at_;
    }

    /// Where the next word is looked for, in bytes from the beginning of the text.
    std::size_t position() const { return at_; }
    void go_to(std::size_t position) { at_ = position; }
    std::string_view text() const { return text_; }

private:
    bool at_blank_or_comment() const { return is_blank(text_[at_]) || (has_comments_ && text_[at_] == '#'); }
    void step() {
        if (has_comments_ && text_[at_] == '#')
            skip_line();
        else
            ++at_;
    }
    std::string_view take() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && !is_line_end(text_[at_]) && !at_blank_or_comment()) ++at_;
        return text_.substr(begin, at_ - begin);
    }

    std::string_view text_;
    bool has_comments_;
    std::size_t at_ = 0;
};

/// Number of the line that this byte is in, from 1.
std::size_t line_number(std::string_view text, std::size_t position);

/// The number that is nearest to a decimal text ("0.1", "-1e-3", "+2", "inf", "nan"); nothing for another text.
/// Beyond the range of doubles: infinite, or zero.
std::optional<double> to_double(std::string_view word);

/// A whole number of at most 64 bits; nothing for another text.
std::optional<std::int64_t> to_integer(std::string_view word);

/// A word of a file, for messages: quoted and not too long.
std::string in_quotes(std::string_view word);

}  // namespace elastolab
