#pragma once

namespace elastolab {

struct PanelContext;
class FileQuestions;

/// The kept probes: their values now, and their course over the last changes.
class ProbePanel {
public:
    /// files: lives longer.
    explicit ProbePanel(FileQuestions& files) : files_(files) {}
    void draw(const PanelContext& context);

private:
    FileQuestions& files_;
};

}  // namespace elastolab
