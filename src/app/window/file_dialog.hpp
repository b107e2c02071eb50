#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace elastolab {

/// A window in which a person finds a file to open, or a name to save under.
class FileDialog {
public:
    struct Purpose {
        std::string title;                    ///< "Open a mesh or scene"
        std::vector<std::string> extensions;  ///< of the files shown, with dot; empty: all
        std::string suggestion;               ///< name to save under; empty: an existing file is to be opened
        std::function<void(const std::filesystem::path&)> done;
        std::function<void()> cancelled = {};  ///< may be empty
        std::filesystem::path folder = {};     ///< to begin in; empty: the last one
    };

    void open(Purpose purpose);
    bool is_open() const { return open_; }
    /// Names of files and folders that it shows.
    void visit_texts(const std::function<void(std::string_view)>& visit) const;
    /// Draws it, when it is open, in the middle of the window.
    void draw(float scale);

private:
    struct Entry {
        std::filesystem::path path;
        std::string shown;
        bool is_folder = false;
    };
    std::string kind() const;
    void list_folder();
    void draw_places();
    void draw_entries();
    void draw_name(float scale);
    void accept(const std::filesystem::path& file);
    bool is_saving() const { return !purpose_.suggestion.empty(); }

    Purpose purpose_;
    bool open_ = false, opening_ = false;
    bool all_files_ = false;        ///< listed, whatever their extension
    bool asks_name_ = false;        ///< the field of the name takes the keys next
    bool enter_was_used_ = false;   ///< in this frame, for a folder
    bool opened_by_enter_ = false;  ///< perhaps: the key has not been seen up yet
    std::filesystem::path folder_;
    std::vector<Entry> entries_;
    std::string name_, problem_;
    std::filesystem::path to_replace_;  ///< asked for confirmation
};

/// The name to save under: with the extension of the suggestion when it has none of those of the purpose.
std::filesystem::path with_extension(const std::filesystem::path& file, const FileDialog::Purpose& purpose);

}  // namespace elastolab
