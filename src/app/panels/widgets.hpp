#pragma once

#include <cstddef>
#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "app/names.hpp"
#include "render/colour.hpp"

struct ImVec4;

namespace elastolab {

/// Numbers for people: "12 480", "0.0123", "(1, 0, 0.5)". Bytes and seconds: base/text.hpp.
std::string count_text(long long count);
std::string number_text(double value);
std::string vector_text(const Eigen::Vector3d& v);

ImVec4 imgui_colour(const Colour& colour, float opacity = 1.0f);
unsigned imgui_packed(const Colour& colour, float opacity = 1.0f);

/// With line breaks at spaces, so that no line is wider than this [pixels]; but for words that are. Dear ImGui by
/// itself breaks behind the point of a number, too.
std::string broken_at_spaces(const std::string& text, float width,
                             const std::function<float(const std::string&)>& width_of);
/// An explanation that appears when the mouse rests on the item before.
void tooltip(const char* text);
/// A paragraph in this colour.
void paragraph(const std::string& text, const Colour& colour);
/// Label left, value right, in one line.
void fact(const char* label, const std::string& value, const Colour& label_colour);
/// One of several things that exclude each other.
struct Segment {
    const char* label;
    const char* explanation;
};
/// Colours of the segment that is chosen.
struct SegmentColours {
    Colour face, text;
};
/// Buttons that fill a row, as wide as their labels need, or several rows where one is too short; that with the number
/// `chosen` stands out. Which one was clicked.
std::optional<std::size_t> draw_segments(const SegmentColours& colours, std::span<const Segment> segments,
                                         std::size_t chosen);
/// Width for items whose label stands to their right.
void set_item_width(float scale);

/// Numbers with a label to their right; true while they are typed. unit: written behind each. noise: what is not larger
/// is rounding, and shown as 0. Each has as many digits as its field holds. What is no number leaves it as it is
/// (typed_number()).
bool draw_numbers(const char* label, double* values, int n, const char* unit, float scale, double noise = 0.0);
/// One by itself.
bool draw_number(const char* label, double& value);
/// One of them that counts once its field is left: "0.5" passes through "0".
class NumberField {
public:
    /// What was typed, when the field is left; nothing where it is the value.
    std::optional<double> draw(const char* label, double value, float scale);

private:
    std::optional<double> typed_;
};
/// Fields in which nothing can be typed, as nothing has a value there.
void draw_no_numbers(const char* label, int n, float scale);
/// What was done to a row of a list.
struct RowAnswer {
    bool clicked = false, removed = false;
};

/// A row that can be selected, with a button at its right that removes what it stands for.
RowAnswer draw_row(const std::string& text, bool selected, const Colour& colour, float scale);

/// What is typed into a slider (after Ctrl + click) is kept between its ends, too.
bool slider(const char* label, double& value, double low, double high, const char* format, float scale);
bool slider(const char* label, int& value, int low, int high, const char* format, float scale);
/// Logarithmic.
bool factor_slider(const char* label, double& value, double low, double high, const char* format, float scale);

/// A list of choices, each with its explanation. True when another one was chosen.
template <class Value>
bool choose(const char* label, Value& value, std::span<const Choice<Value>> choices);

bool begin_choice(const char* label, const char* preview);
bool choice_entry(const char* label, const char* explanation, bool selected);
void end_choice();

template <class Value>
bool choose(const char* label, Value& value, std::span<const Choice<Value>> choices) {
    const Choice<Value>* present = &choices.front();
    for (const Choice<Value>& choice : choices)
        if (choice.value == value) present = &choice;
    const bool open = begin_choice(label, present->label);
    bool changed = false;
    if (open) {
        for (const Choice<Value>& choice : choices)
            if (choice_entry(choice.label, choice.explanation, choice.value == value)) {
                changed = choice.value != value;
                value = choice.value;
            }
        end_choice();
    } else {
        tooltip(present->explanation);
    }
    return changed;
}

}  // namespace elastolab
