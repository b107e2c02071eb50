#pragma once

namespace elastolab {

class FileQuestions;
class ViewerState;

/// The menu of what leaves the program for others: meshes with their fields, and tables.
void draw_export_menu(ViewerState& state, FileQuestions& files);

}  // namespace elastolab
