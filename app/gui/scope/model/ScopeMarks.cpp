#include "app/gui/scope/model/ScopeMarks.h"

#include <QCoreApplication>

namespace tacto::gui {

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
