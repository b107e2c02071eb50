// Every test has a list of recent files of its own, and so has every program that it starts.
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>

#include "support/temporary_folder.hpp"

namespace elastolab::test {
namespace {

class StateFolder : public testing::EmptyTestEventListener {
    void OnTestStart(const testing::TestInfo&) override {
        folder_.emplace();
        setenv("XDG_STATE_HOME", folder_->path().c_str(), 1);
    }
    void OnTestEnd(const testing::TestInfo&) override { folder_.reset(); }

    std::optional<TemporaryFolder> folder_;
};

[[maybe_unused]] const bool is_listening = [] {
    testing::UnitTest::GetInstance()->listeners().Append(new StateFolder);
    return true;
}();

}  // namespace
}  // namespace elastolab::test
