#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "app/viewer_requests.hpp"
#include "app/window/file_dialog.hpp"

namespace elastolab {

class ViewerState;

/// A name for an output of this scene, by the name of its mesh.
std::string suggested_name(const ViewerState& state, const std::string& ending);

/// Asks which file to open, and under what names to save, in one dialog that all panels share. What is answered goes
/// to the state, which must live as long as the question.
class FileQuestions {
public:
    void ask_open(ViewerState& state);
    /// Overwrites the scene's own file if this session wrote it already, else as save_as().
    void save(ViewerState& state);
    void save_as(ViewerState& state);
    /// Asks for the name of a scene that is to be saved before it is replaced; without a name it stays.
    void ask_name_of_unsaved(ViewerState& state);
    void ask_export(ViewerState& state, const std::string& ending);
    void ask_screenshot(ViewerState& state);
    /// ending: of the suggested name.
    void ask_picture(ViewerState& state, const PictureRequest& picture, const std::string& ending);
    void ask_probes(ViewerState& state);
    void ask_timings(ViewerState& state);

    bool asking() const { return dialog_.is_open(); }
    void draw(float scale) { dialog_.draw(scale); }
    void visit_texts(const std::function<void(std::string_view)>& visit) const { dialog_.visit_texts(visit); }

private:
    void ask_name_of_scene(ViewerState& state, std::function<void(const std::filesystem::path&)> done,
                           std::function<void()> cancelled = {});

    FileDialog dialog_;
};

}  // namespace elastolab
