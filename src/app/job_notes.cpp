#include "app/job_notes.hpp"

namespace elastolab {

bool tell_end(BackgroundJob<std::string>& job, Messages& messages) {
    switch (job.poll()) {
        case JobEvent::finished:
            messages.note(job.take());
            return true;
        case JobEvent::failed:
            messages.error(job.failure());
            return true;
        case JobEvent::cancelled:
        case JobEvent::none:
            return false;
    }
    return false;
}

}  // namespace elastolab
