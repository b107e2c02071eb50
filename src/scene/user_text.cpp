#include "scene/user_text.hpp"

#include <filesystem>
#include <new>
#include <system_error>

#include "base/error.hpp"
#include "base/text.hpp"

namespace elastolab {

std::string user_text(const std::exception& error) {
    if (dynamic_cast<const Error*>(&error) != nullptr) return one_line(error.what());
    if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr)
        return "The memory that this process may have is used up. Use a coarser mesh or a smaller file, or the mode "
               "on-demand; or raise its limits (ulimit -v, ulimit -d).";
    if (const auto* system = dynamic_cast<const std::system_error*>(&error);
        system != nullptr && system->code() == std::errc::resource_unavailable_try_again)
        return "No further thread can be started: this process is at the limit of its memory or of its threads. Raise "
               "it (ulimit -v, ulimit -u), or use fewer threads.";
    if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error)) {
        if (std::error_code gone; std::filesystem::current_path(gone).empty())
            return "The working directory does not exist any more. Change to another folder and start again.";
        return one_line(file->path1().string() + ": " + file->code().message() + ". Check the path.");
    }
    return "Internal error: " + one_line(error.what()) + ". Please report it.";
}

}  // namespace elastolab
