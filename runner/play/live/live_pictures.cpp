#include "runner/play/live/live_pictures.h"

#include <utility>

namespace fernlicht {

bool LivePictures::wanted(bool captured) {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    return lock && (captured ? captured_.size() < max_captured : !newest_);
}

bool LivePictures::offer(LivePicture& picture) {
    {
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock)
            return false;
        if (picture.captured)
            captured_.push_back(std::move(picture));
        else
            newest_ = std::move(picture);
    }
    news_.release();
    return true;
}

std::optional<LivePicture> LivePictures::take() {
    for (;;) {
        {
            const std::scoped_lock lock(mutex_);
            if (!captured_.empty()) {
                LivePicture picture = std::move(captured_.front());
                captured_.pop_front();
                return picture;
            }
            if (newest_)
                return std::exchange(newest_, std::nullopt);
            if (ended_)
                return std::nullopt;
        }
        news_.acquire();
    }
}

void LivePictures::end() {
    {
        const std::scoped_lock lock(mutex_);
        ended_ = true;
        newest_.reset(); // what is to be stored is drawn still
    }
    news_.release();
}

} // namespace fernlicht
