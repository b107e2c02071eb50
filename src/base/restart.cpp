#include "base/restart.hpp"

#include <unistd.h>

#include <filesystem>
#include <system_error>

namespace elastolab {

void restart(char** argv) {
    constexpr const char* kSelf = "/proc/self/exe";
    std::error_code error;
    const std::filesystem::path file = std::filesystem::read_symlink(kSelf, error);
    if (!error) execv(file.c_str(), argv);  // begun by the link, the process would be called "exe"
    execv(kSelf, argv);                     // for a file that was replaced meanwhile
}

}  // namespace elastolab
