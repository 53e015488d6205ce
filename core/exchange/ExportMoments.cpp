#include "core/exchange/ExportMoments.h"

#include <algorithm>
#include <cmath>

#include "core/base/JsonText.h"
#include "core/session/SessionTypes.h"

namespace tacto {

namespace {

std::string amplitudeOf(const ExportTrain& train) {
    if (std::isfinite(train.told_v)) return fmt::format(" {:.4g} V", train.told_v);
    if (std::isfinite(train.told_ma)) return fmt::format(" {:.4g} mA", train.told_ma);
    return {};
}

}  // namespace

std::string wordsFor(const ExportTrain& train) {
    using enum ExportTrain::Outcome;
    const auto because = train.reason.empty() ? std::string() : ": " + train.reason;
    switch (train.outcome) {
        case Delivered:
            return "train" + amplitudeOf(train);
        case Check:
            return "check" + amplitudeOf(train);
        case Burst:
            return "burst";
        case Refused:
        case Voided:
        case Failed:
            return fmt::format("train {}{}{}", nameOf(train.outcome), amplitudeOf(train), because);
        case Unknown:
            break;
    }
    return "train without a report" + amplitudeOf(train);
}

std::string wordsFor(const SessionTrial& trial) { return fmt::format("trial {} {}", trial.number, trial.condition); }

std::optional<std::string> wordsFor(const SessionRow& event) {
    if (event.name != "interlock" && event.name != "note" && event.name != kOperatorMarkEvent) return std::nullopt;
    return event.name + " " + textOr(event.body, "text");
}

Result<void> forEachMomentInWords(const ExportSource& source,
                                  const std::function<Result<void>(const ExportMoment&)>& visit) {
    std::vector<ExportMoment> few;  // all but trains, which may be many
    for (const auto& mark : source.marks()) few.push_back({0, mark});
    for (const auto& trial : source.trialRows()) few.push_back({toSeconds(trial.at), wordsFor(trial)});
    for (const auto& event : source.eventRows()) {
        if (auto words = wordsFor(event)) few.push_back({toSeconds(event.at), *std::move(words)});
    }
    std::ranges::stable_sort(few, {}, &ExportMoment::time_s);
    auto next = few.begin();
    const auto flush = [&](double until_s) -> Result<void> {
        for (; next != few.end() && next->time_s <= until_s; ++next)
            if (auto visited = visit(*next); !visited) return visited;
        return {};
    };
    auto read = source.forEachTrain([&](const ExportTrain& train) -> Result<void> {
        if (!std::isfinite(train.time_s)) return {};
        if (auto flushed = flush(train.time_s); !flushed) return flushed;
        return visit({train.time_s, wordsFor(train)});
    });
    return read ? flush(INFINITY) : read;
}

}  // namespace tacto
