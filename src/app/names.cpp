#include "app/names.hpp"

#include <algorithm>
#include <cctype>

namespace elastolab {

std::string title(MethodKind kind) {
    std::string text(name(kind));
    // Abbreviations keep capitals: "linear-bem" is "Linear BEM", "fem" is "FEM".
    std::string result;
    std::size_t begin = 0;
    while (begin < text.size()) {
        std::size_t end = std::min(text.find('-', begin), text.size());
        std::string word = text.substr(begin, end - begin);
        const auto upper = [](unsigned char c) { return static_cast<char>(std::toupper(c)); };
        if (word.size() == 3)
            std::transform(word.begin(), word.end(), word.begin(), upper);
        else
            word[0] = upper(static_cast<unsigned char>(word[0]));
        result += (result.empty() ? "" : " ") + word;
        begin = end + 1;
    }
    return result;
}

}  // namespace elastolab
