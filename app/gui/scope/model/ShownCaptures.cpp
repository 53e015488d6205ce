#include "app/gui/scope/model/ShownCaptures.h"

#include <QCoreApplication>
#include <algorithm>

namespace tacto::gui {

namespace {

constexpr std::size_t kMaxInRoll = 600;
constexpr std::size_t kMaxSamplesKept = 40'000'000;

}  // namespace

void ShownCaptures::setPersistence(int captures) { persistence_ = std::clamp(captures, 0, kMaxBehind); }

void ShownCaptures::setRoll(bool roll) {
    roll_ = roll;
    if (!roll_ || !newest_) dropOldest();
}

bool ShownCaptures::isFollowedBy(const ShownCapture& next) const {
    return newest_ && newest_->source.isEmpty() && next.source.isEmpty();
}

void ShownCaptures::show(ShownPtr next) {
    if (isFollowedBy(*next))
        behind_.push_front(std::move(newest_));
    else
        behind_.clear();
    newest_ = std::move(next);
    dropOldest();
}

void ShownCaptures::clear() {
    newest_.reset();
    behind_.clear();
}

void ShownCaptures::dropOldest() {
    const std::size_t most = roll_ ? kMaxInRoll : static_cast<std::size_t>(kMaxBehind);
    std::size_t keep = 0;
    std::size_t samples = 0;
    while (keep < behind_.size() && keep < most) {
        samples += behind_[keep]->capture->samples() * behind_[keep]->traces.size();
        if (samples > kMaxSamplesKept) break;
        ++keep;
    }
    behind_.resize(keep);
}

void ScopeMarks::add(MomentMark mark) {
    if (marks_.size() == kMaxKept) marks_.erase(marks_.begin());
    marks_.push_back(std::move(mark));
}

std::vector<MomentMark> ScopeMarks::between(double left_s, double right_s, double zero_s) const {
    std::vector<MomentMark> seen;
    for (const auto& mark : marks_) {
        const double at = mark.at_s - zero_s;
        if (at >= left_s && at <= right_s) seen.push_back({at, mark.word});
    }
    return seen;
}

QString ScopeMarks::beside(const ShownCapture& shown, const ShownCapture* before) const {
    if (marks_.empty()) return {};
    const auto& last = marks_.back();
    if (last.at_s > shown.end_s()) return QCoreApplication::translate("ScopeMarks", "after it: “%1”").arg(last.word);
    const bool between = before != nullptr && last.at_s > before->end_s() && last.at_s < shown.capture->start_s;
    return between ? QCoreApplication::translate("ScopeMarks", "before it: “%1”").arg(last.word) : QString();
}

}  // namespace tacto::gui
