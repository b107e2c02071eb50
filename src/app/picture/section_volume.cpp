#include "app/picture/section_volume.hpp"

namespace elastolab {

const Volume* SectionVolume::of(const MethodRunner& runner) {
    const std::shared_ptr<const Model>& model = runner.model();
    if (!model || !model->method().kind->has_inside) return nullptr;
    const double poisson_ratio = model->body().material.poisson_ratio;
    if (poisson_ratio_ == poisson_ratio) return volume_.get();
    forget();
    poisson_ratio_ = poisson_ratio;
    job_.start([model](Control& control) { return Volume::of(model, control); });
    return nullptr;
}

void SectionVolume::forget() {
    job_.cancel();
    volume_.reset();
    poisson_ratio_.reset();
}

bool SectionVolume::poll() {
    const JobEvent event = job_.poll();
    if (event == JobEvent::finished) volume_ = job_.take();
    return event == JobEvent::finished || event == JobEvent::failed;
}

}  // namespace elastolab
