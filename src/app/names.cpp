#include "app/names.hpp"

#include <map>
#include <regex>

#include "methods/registry.hpp"

namespace elastolab {

std::string title(MethodKind kind) { return std::string(kind->label); }

std::string with_titles(std::string text) {
    for (const MethodKind kind : all_methods()) {
        const std::regex whole_word("(^|[^\\w./-])" + std::string(kind->name) + R"((?![\w/-]|\.\w))");
        text = std::regex_replace(text, whole_word, "$1" + title(kind));
    }
    return text;
}

std::string stage_words(std::string_view stage) {
    static const std::map<std::string_view, std::string> words = {{"proxy", "wrapping the surface"},
                                                                  {"tetrahedralize", "making tetrahedra"},
                                                                  {"integrate", "integrating"},
                                                                  {"integrate tractions", "integrating tractions"},
                                                                  {"analyse", "ordering the equations"},
                                                                  {"factorise", "factorising"},
                                                                  {"precondition", "preconditioning"},
                                                                  {"constrain", "preparing what is held"},
                                                                  {"refine", "refining the answer"},
                                                                  {"solve", "solving"},
                                                                  {"check", "checking"}};
    const auto found = words.find(stage);
    return found != words.end() ? found->second : "computing " + std::string(stage);
}

}  // namespace elastolab
