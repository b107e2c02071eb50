#include "cli/complaint.hpp"

#include <iostream>
#include <utility>

#include "base/control.hpp"
#include "base/text.hpp"
#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "scene/user_text.hpp"

namespace elastolab {

namespace {

std::string& own_name() {
    static std::string name = "elastolab";
    return name;
}

}  // namespace

const std::string& program_name() { return own_name(); }
void set_program_name(std::string name) { own_name() = std::move(name); }

int complain(const std::string& text, int exit_code) {
    std::cerr << program_name() << ": " << one_line(text) << std::endl;
    return exit_code;
}

int exit_code_of(const std::function<int()>& run, bool silent) {
    const auto end = [&](const std::string& text, int exit_code) {
        return silent ? exit_code : complain(text, exit_code);
    };
    try {
        const int code = run();
        std::cout.flush();
        return std::cout ? code : end("Standard output cannot be written. Is the disk full?", kFailure);
    } catch (const UsageError& error) {
        return end(error.what(), kBadUsage);
    } catch (const Interrupted& interrupted) {
        return end(interrupted.what(), interrupt_exit_code());
    } catch (const Cancelled&) {
        return end("Interrupted; no output was written.", interrupt_exit_code());
    } catch (const std::exception& error) {
        return end(user_text(error), kFailure);
    }
}

}  // namespace elastolab
