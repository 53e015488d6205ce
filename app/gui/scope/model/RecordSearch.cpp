#include "app/gui/scope/model/RecordSearch.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "app/report/NumberText.h"

namespace tacto::gui {

void RecordSearch::go(int step, const SampleTrigger& trigger, const QString& unit) {
    const auto& shown = model_.shown();
    if (!shown) return;
    if (shows() && trigger_ == trigger && unit_ == unit) return move(step);
    of_ = shown->capture;
    trigger_ = trigger;
    unit_ = unit;
    pipe_.search(shown, trigger, unit, [this, step, of = shown->capture.get()](std::vector<double> places) {
        if (of == of_.lock().get() && shows()) found(step, std::move(places));
    });
}

void RecordSearch::found(int step, std::vector<double> places) {
    places_ = std::move(places);
    at_ = -1;
    move(step);
}

void RecordSearch::move(int step) {
    const auto count = std::ssize(places_);
    if (count == 0) {
        model_.markTrigger({});
        return emit said(tr("Nothing in this record matches the trigger set here."));
    }
    const auto& record = *model_.shown()->capture;
    const auto timeOf = [&](double place) { return record.start_s + place / record.rate_hz - model_.zero_s(); };
    const auto& view = model_.viewport();
    const bool whole = view.left_s <= timeOf(0) && view.right_s() >= timeOf(static_cast<double>(record.samples() - 1));
    if (at_ >= 0 && left_s_ == view.left_s) {
        at_ += step;
    } else {
        // A match in the middle is neither the next nor the previous one.
        const double middle = view.left_s + view.width_s() / 2 + step * 0.5 / record.rate_hz;
        const auto before = std::ranges::count_if(places_, [&](double place) { return timeOf(place) <= middle; });
        at_ = step > 0 ? (whole ? 0 : before) : (whole ? count - 1 : before - 1);
    }
    const bool beyond = at_ < 0 || at_ >= count;
    at_ = std::clamp<std::ptrdiff_t>(at_, 0, count - 1);
    const double time_s = timeOf(places_[static_cast<std::size_t>(at_)]);
    if (!whole) model_.setTimeCentre(time_s);
    model_.markTrigger(time_s);
    left_s_ = model_.viewport().left_s;
    const auto text = tr("Match %1 of %2, at %3").arg(at_ + 1).arg(count).arg(quantityText(time_s, "s", 4));
    emit said(beyond ? tr("%1: there is no further one.").arg(text) : text + '.');
}

}  // namespace tacto::gui

#include "moc_RecordSearch.cpp"
