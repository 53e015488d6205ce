// ExportMoments.h - what happened in a session, in a few words each: what XDF has as markers, EDF and BDF as
// annotations. A part of the exports.
//
// Thread-safety: as ExportSource.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/exchange/ExportSource.h"

namespace tacto {

struct ExportMoment {
    double time_s = 0;
    std::string text;  ///< "trial 12 rough-low", "train 39.95 V", "interlock armed"
};

/// The words of one moment; none for an event that is no moment.
[[nodiscard]] std::string wordsFor(const ExportTrain& train);
[[nodiscard]] std::string wordsFor(const SessionTrial& trial);
[[nodiscard]] std::optional<std::string> wordsFor(const SessionRow& event);

/// The marks at 0, then each trial, train, change of the interlock and note, in the order of their times.
[[nodiscard]] Result<void> forEachMomentInWords(const ExportSource& source,
                                                const std::function<Result<void>(const ExportMoment&)>& visit);

}  // namespace tacto
