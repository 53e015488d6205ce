// Remembered.h - reads values from the settings file, which a person may have edited or a crash may have cut short. A
// value that is missing, of another type or out of range reads as nothing, and the caller's default stays.
//
// Thread-safety: only on the GUI thread, like QSettings.
#pragma once

#include <QSettings>
#include <optional>

#include "app/gui/scope/model/Viewport.h"

namespace tacto::gui {

/// Reads a finite number from `low` to `high`.
[[nodiscard]] std::optional<double> rememberedNumber(const QSettings& settings, const QString& key, double low,
                                                     double high);
/// Reads "true" or "false"; nothing for any other text.
[[nodiscard]] std::optional<bool> rememberedFlag(const QSettings& settings, const QString& key);

/// The view of the bench's captures that the user chose, kept for the next start. Nothing: the whole record is shown.
struct ChosenView {
    struct Time {
        double left_s = 0, perDivision_s = 0;
    };
    std::optional<Time> time;
    std::map<QString, LaneScale> lanes;  ///< empty: the scales are fitted
};

void saveView(QSettings& settings, const ChosenView& chosen);
/// Reads the view. Leaves out values that are missing or that saveView() did not write.
[[nodiscard]] ChosenView restoredView(QSettings& settings);

}  // namespace tacto::gui
