#pragma once

#include "app/panels/examples_panel.hpp"

namespace elastolab {

struct PanelContext;
class BodyPanel;
class FileQuestions;
class PicturePanel;
class SelectionPanel;
class ViewerState;

/// The menu bar. What is chosen there begins in the panel that it belongs to.
class MenuPanel {
public:
    struct Beginners {  ///< all live longer
        FileQuestions& files;
        BodyPanel& body;
        PicturePanel& picture;
        SelectionPanel& selection;
    };
    explicit MenuPanel(const Beginners& panels) : panels_(panels) {}
    void draw(const PanelContext& context);

private:
    void draw_file(ViewerState& state, float scale);
    void draw_edit(ViewerState& state);

    Beginners panels_;
    ExamplesPanel examples_;
};

}  // namespace elastolab
