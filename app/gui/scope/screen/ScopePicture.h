// ScopePicture.h - what is on the oscilloscope's screen as a picture that says about itself what it shows: title, date,
// devices, scales, readings, and that it is simulated.
#pragma once

#include <QDateTime>
#include <QImage>
#include <QSize>
#include <QString>
#include <memory>
#include <optional>

#include "app/gui/theme/PlotPicture.h"
#include "core/measure/CaptureMask.h"
#include "core/session/SessionTypes.h"

namespace tacto::gui {

class ScopeModel;
struct ScopeLane;
class ScopeScreen;

/// "V 20 V/div".
[[nodiscard]] QString laneScaleText(const ScopeModel& model, const ScopeLane& lane);

/// "V 20 V/div · I 20 mA/div · 100 µs/div · 20000 samples at 2 MS/s · averaged 16": as the model has it.
[[nodiscard]] QString scalesText(const ScopeModel& model);

/// Title, date, the devices of the bench or the file's name, scales, then `more`. `bench` may be null.
[[nodiscard]] PictureCaption captionOf(const ScopeModel& model, const SessionAbout* bench, const QStringList& more);

/// The screen at a moment: it is saved as it was then, however long a dialog asks for the file's name.
struct ScopeStill {
    std::shared_ptr<const ScopeModel> model;
    std::shared_ptr<const CaptureMask> mask;
    QString alarm;
    QSize size;  ///< the screen's size
    PictureCaption caption;
    QDateTime taken;  ///< when the capture came from the bench, or when this was made from a file's
};
[[nodiscard]] ScopeStill stillOf(const ScopeModel& model, const ScopeScreen& screen, const PictureCaption& caption);

/// Saves by the path's ending: .png (twice the screen's resolution), .svg or .pdf, as large as the screen and its
/// caption. Returns one sentence that says what went wrong.
[[nodiscard]] std::optional<QString> saveScopePicture(const ScopeStill& still, const QString& path);
[[nodiscard]] QImage scopePicture(const ScopeStill& still);

}  // namespace tacto::gui
