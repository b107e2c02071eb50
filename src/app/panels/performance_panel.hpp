#pragma once

namespace elastolab {

struct PanelContext;
class FileQuestions;

/// Times of frames and of the stages of the precomputation, memory, and the recording of timings.
class PerformancePanel {
public:
    /// files: lives longer.
    explicit PerformancePanel(FileQuestions& files) : files_(files) {}
    void draw(const PanelContext& context);

private:
    FileQuestions& files_;
};

}  // namespace elastolab
