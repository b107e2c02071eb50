#include "scene/live/model_keeper.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "base/error.hpp"
#include "bem/collocation/method.hpp"
#include "methods/registry.hpp"
#include "support/wait_until.hpp"

namespace elastolab {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

/// A model of nothing, told apart by the name of its body.
std::shared_ptr<const Model> model_called(const std::string& name) {
    const Body body{.name = name, .surface = std::make_shared<const SurfaceMesh>(), .material = {}};
    return std::make_shared<const Model>(body, Method{.kind = kLinearBem}, std::vector<Model::Part>{}, ModelFacts{});
}

ModelJob::Work giving(const std::string& name) {
    return [name](Control&) { return model_called(name); };
}

/// Works until it is cancelled, and says that it has begun.
ModelJob::Work endless(std::atomic<bool>& begun) {
    return [&begun](Control& control) -> std::shared_ptr<const Model> {
        control.begin_stage("forever");
        control.set_progress(0.5);
        begun = true;
        while (true) {
            control.checkpoint();
            std::this_thread::sleep_for(1ms);
        }
    };
}

JobEvent wait_for_event(ModelJob& job) {
    JobEvent event = JobEvent::none;
    test::wait_for([&] { return (event = job.poll()) != JobEvent::none; });
    return event;
}

TEST(ModelJob, BringsTheModelOnce) {
    ModelJob job;
    job.start(giving("first"));
    EXPECT_EQ(wait_for_event(job), JobEvent::finished);
    EXPECT_EQ(job.take()->body().name, "first");
    EXPECT_FALSE(job.running());
    EXPECT_GE(job.last_seconds(), 0.0);
    EXPECT_EQ(job.poll(), JobEvent::none);
}

TEST(ModelJob, KeepsNothingOfAModelThatWasTaken) {
    ModelJob job;
    job.start(giving("taken"));
    wait_for_event(job);
    std::shared_ptr<const Model> model = job.take();
    const std::weak_ptr<const Model> trace = model;
    model.reset();
    EXPECT_TRUE(trace.expired());
    EXPECT_EQ(job.take(), nullptr);
}

TEST(ModelJob, ShowsStageAndProgressWhileItRuns) {
    std::atomic<bool> begun{false};
    ModelJob job;
    job.start(endless(begun));
    test::wait_for([&] { return begun.load(); });
    EXPECT_TRUE(job.running());
    EXPECT_STREQ(job.status().stage, "forever");
    EXPECT_EQ(job.status().progress, 0.5);
    EXPECT_GT(job.status().seconds, 0.0);
    EXPECT_EQ(job.poll(), JobEvent::none);
}

TEST(ModelJob, ACancelLeavesTheModelBeforeIt) {
    std::atomic<bool> begun{false};
    ModelJob job;
    job.start(giving("old"));
    wait_for_event(job);
    job.start(endless(begun));
    test::wait_for([&] { return begun.load(); });
    job.cancel();
    EXPECT_EQ(wait_for_event(job), JobEvent::cancelled);
    EXPECT_EQ(job.take()->body().name, "old");
    EXPECT_EQ(job.failure(), "");
}

TEST(ModelJob, DropsAResultThatComesAfterACancel) {
    std::atomic<bool> go{false};
    ModelJob job;
    job.start([&](Control&) {
        test::wait_for([&] { return go.load(); });
        return model_called("too late");
    });
    job.cancel();
    go = true;
    EXPECT_EQ(wait_for_event(job), JobEvent::cancelled);
    EXPECT_EQ(job.take(), nullptr);
}

TEST(ModelJob, DropsAFailureThatComesAfterACancel) {
    std::atomic<bool> go{false};
    ModelJob job;
    job.start([&](Control&) -> std::shared_ptr<const Model> {
        test::wait_for([&] { return go.load(); });
        throw MeshError("of what nobody wants any more");
    });
    job.cancel();
    go = true;
    EXPECT_EQ(wait_for_event(job), JobEvent::cancelled);
    EXPECT_EQ(job.failure(), "");
}

TEST(ModelJob, AFailureLeavesTheModelBeforeItAndSaysWhy) {
    ModelJob job;
    job.start(giving("old"));
    wait_for_event(job);
    job.start([](Control&) -> std::shared_ptr<const Model> { throw MeshError("bunny.obj: is broken. Mend it."); });
    EXPECT_EQ(wait_for_event(job), JobEvent::failed);
    EXPECT_EQ(job.take()->body().name, "old");
    EXPECT_EQ(job.failure(), "bunny.obj: is broken. Mend it.");
    job.start([](Control&) -> std::shared_ptr<const Model> { throw std::bad_alloc(); });
    EXPECT_EQ(wait_for_event(job), JobEvent::failed);
    EXPECT_THAT(job.failure(), HasSubstr("memory"));
    job.start(giving("new"));
    EXPECT_EQ(wait_for_event(job), JobEvent::finished);
    EXPECT_EQ(job.failure(), "");
}

TEST(ModelJob, ANewRequestReplacesTheOldOnesAndNeverRunsBesideThem) {
    std::atomic<int> running{0}, most{0};
    ModelJob job;
    for (int i = 0; i < 20; ++i)
        job.start([&, i](Control& control) {
            most = std::max(most.load(), ++running);
            for (int step = 0; step < 5 && !control.cancelled(); ++step) std::this_thread::sleep_for(1ms);
            --running;
            control.checkpoint();
            return model_called(std::to_string(i));
        });
    EXPECT_EQ(wait_for_event(job), JobEvent::finished);
    EXPECT_EQ(job.take()->body().name, "19");
    EXPECT_EQ(most, 1);
}

/// Threads of this process.
std::ptrdiff_t n_threads() {
    return std::distance(std::filesystem::directory_iterator("/proc/self/task"), std::filesystem::directory_iterator());
}

TEST(ModelJob, ManyRequestsDuringOneThatCannotBeStoppedWaitInOneThread) {
    std::atomic<bool> begun{false}, go{false};
    std::atomic<int> n_begun{0};
    ModelJob job;
    job.start([&](Control&) {
        begun = true;
        test::wait_for([&] { return go.load(); });  // a library that knows of no checkpoints
        return model_called("stroke 0");
    });
    test::wait_for([&] { return begun.load(); });
    const std::ptrdiff_t before = n_threads();
    for (int i = 1; i <= 200; ++i)
        job.start([&n_begun, i](Control&) {
            ++n_begun;
            return model_called("stroke " + std::to_string(i));
        });
    EXPECT_EQ(n_threads(), before);
    go = true;
    EXPECT_EQ(wait_for_event(job), JobEvent::finished);
    EXPECT_EQ(job.take()->body().name, "stroke 200");
    EXPECT_EQ(n_begun, 1);
}

TEST(ModelJob, WhatARequestHoldsIsGoneWhenItIsReplaced) {
    std::atomic<bool> begun{false};
    ModelJob job;
    job.start(endless(begun));
    test::wait_for([&] { return begun.load(); });
    auto model = model_called("held");
    const std::weak_ptr<const Model> trace = model;
    job.cancel();
    job.start([model](Control&) { return model; });
    job.start(giving("new"));
    model.reset();
    EXPECT_EQ(wait_for_event(job), JobEvent::finished);
    EXPECT_TRUE(trace.expired());
}

TEST(ModelJob, ShutsDownWhileItRuns) {
    std::atomic<bool> begun{false}, ended{false};
    {
        ModelJob job;
        job.start([&](Control& control) {
            try {
                return endless(begun)(control);
            } catch (...) {
                ended = true;
                throw;
            }
        });
        test::wait_for([&] { return begun.load(); });
        job.start(giving("never seen"));
    }
    EXPECT_TRUE(ended);
}

/// In a process of its own, which may take no memory for the stack of a thread.
TEST(ModelJob, FailsWhereNoThreadCanBeStarted) {
    const auto start_without_memory = [] {
        rlimit none{};
        getrlimit(RLIMIT_AS, &none);
        none.rlim_cur = 1;
        setrlimit(RLIMIT_AS, &none);
        ModelJob job;
        job.start(giving("never made"));
        const bool failed = job.poll() == JobEvent::failed && job.failure().find("no thread") != std::string::npos;
        none.rlim_cur = none.rlim_max;
        setrlimit(RLIMIT_AS, &none);
        job.start(giving("made later"));
        std::_Exit(failed && wait_for_event(job) == JobEvent::finished ? 0 : 1);
    };
    GTEST_FLAG_SET(death_test_style, "threadsafe");  // no stacks are left of the threads of other tests
    EXPECT_EXIT(start_without_memory(), ::testing::ExitedWithCode(0), "");
}

TEST(ModelJob, CannotBeCancelledWhenItIsIdle) {
    ModelJob job;
    job.cancel();
    EXPECT_EQ(job.poll(), JobEvent::none);
    EXPECT_FALSE(job.running());
    EXPECT_STREQ(job.status().stage, "");
}

}  // namespace
}  // namespace elastolab
