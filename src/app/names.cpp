#include "app/names.hpp"

#include <cctype>
#include <cstddef>
#include <map>

#include "methods/registry.hpp"

namespace elastolab {

std::string title(MethodKind kind) { return std::string(kind->label); }

std::string with_titles(std::string text) {
    const auto is_in_word = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '/' || c == '-';
    };
    const auto stands_alone = [&](std::size_t begin, std::size_t end) {
        if (begin > 0 && (is_in_word(text[begin - 1]) || text[begin - 1] == '.')) return false;
        if (end == text.size()) return true;
        const bool is_ending = text[end] == '.' && end + 1 < text.size() && is_in_word(text[end + 1]);
        return !is_in_word(text[end]) && !is_ending;
    };
    for (const MethodKind kind : all_methods())
        for (std::size_t at = text.find(kind->name); at != std::string::npos; at = text.find(kind->name, at + 1))
            if (stands_alone(at, at + kind->name.size())) text.replace(at, kind->name.size(), kind->label);
    return text;
}

std::string field_title(Field field, MethodKind reference, const UnitNames& units) {
    static const std::map<Field, std::string> stresses = {{Field::von_mises, "von Mises stress"},
                                                          {Field::first_principal, "first principal stress"},
                                                          {Field::third_principal, "third principal stress"},
                                                          {Field::stress_xx, "stress xx"},
                                                          {Field::stress_yy, "stress yy"},
                                                          {Field::stress_zz, "stress zz"},
                                                          {Field::stress_xy, "stress xy"},
                                                          {Field::stress_yz, "stress yz"},
                                                          {Field::stress_xz, "stress xz"}};
    const std::string lengths = " [" + units.of_length() + "]", per_area = " [" + units.of_stress() + "]";
    if (const auto found = stresses.find(field); found != stresses.end()) return found->second + per_area;
    if (field == Field::displacement) return "displacement" + lengths;
    if (const auto axis = displacement_axis(field)) return std::string("displacement ") + "xyz"[*axis] + lengths;
    if (field == Field::difference) return "difference to " + std::string(title(reference)) + lengths;
    return field == Field::traction ? "traction" + per_area : "";
}

std::string after_value(Field field, const UnitNames& units) {
    const bool is_length = field == Field::none || field == Field::displacement || field == Field::difference ||
                           displacement_axis(field).has_value();
    return is_length ? units.after_length() : units.after_stress();
}

std::string stage_words(std::string_view stage) {
    static const std::map<std::string_view, std::string> words = {{"proxy", "wrapping the surface"},
                                                                  {"tetrahedralize", "making tetrahedra"},
                                                                  {"integrate", "integrating"},
                                                                  {"integrate close pairs", "integrating close pairs"},
                                                                  {"integrate tractions", "integrating tractions"},
                                                                  {"integrate loads", "integrating loads"},
                                                                  {"analyse", "ordering the equations"},
                                                                  {"factorise", "factorising"},
                                                                  {"precondition", "preconditioning"},
                                                                  {"constrain", "preparing the constrained set"},
                                                                  {"converge", "converging"},
                                                                  {"solve", "solving"},
                                                                  {"check", "checking"}};
    const auto found = words.find(stage);
    return found != words.end() ? found->second : "computing " + std::string(stage);
}

}  // namespace elastolab
