// ScopePicture.h - what is on the oscilloscope's screen as a picture that says of itself what it shows: title, date,
// devices, scales, readings, and that it is simulated.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QImage>
#include <QString>
#include <QStringList>
#include <optional>

#include "core/session/SessionTypes.h"

namespace tacto::gui {

class ScopeModel;
class ScopeScreen;

/// What stands beside the plot; empty lines are left out.
struct ScopeCaption {
    QString title;  ///< "Oscilloscope · simulated"
    QString date;
    QStringList lines;  ///< devices, scales, trigger, cursors, readings, mask
};

/// "V 20 V/div · I 20 mA/div".
[[nodiscard]] QString laneScalesText(const ScopeModel& model);

/// "V 20 V/div · I 20 mA/div · 100 µs/div · 2 MHz, 20000 samples · averaged 16": as the model has it.
[[nodiscard]] QString scalesText(const ScopeModel& model);

/// Title, date, the devices of the bench or the file's name, scales, then `more`. `bench` may be null.
[[nodiscard]] ScopeCaption captionOf(const ScopeModel& model, const SessionAbout* bench, const QStringList& more);

/// By the path's ending: .png (twice the screen's resolution), .svg or .pdf, as large as the screen and its caption.
/// Returns what went wrong, as a sentence.
[[nodiscard]] std::optional<QString> saveScopePicture(const ScopeModel& model, const ScopeScreen& screen,
                                                      const ScopeCaption& caption, const QString& path);
[[nodiscard]] QImage scopePicture(const ScopeModel& model, const ScopeScreen& screen, const ScopeCaption& caption);

}  // namespace tacto::gui
