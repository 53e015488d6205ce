// ScopePicture.h - a picture of the oscilloscope's screen with a caption: title, date, devices, scales, readings, and
// whether the data are simulated.
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

/// Returns the lane's scale as text: "V 20 V/div".
[[nodiscard]] QString laneScaleText(const ScopeModel& model, const ScopeLane& lane);

/// Describes the model: "V 20 V/div · I 20 mA/div · 100 µs/div · 20000 samples at 2 MS/s · averaged 16".
[[nodiscard]] QString scalesText(const ScopeModel& model);

/// Title, date, the bench's devices or the file's name, scales, then `more`. `bench` may be null.
[[nodiscard]] PictureCaption captionOf(const ScopeModel& model, const SessionAbout* bench, const QStringList& more);

/// The screen at one moment, saved unchanged even if the user takes long to choose a file name.
struct ScopeStill {
    std::shared_ptr<const ScopeModel> model;
    std::shared_ptr<const CaptureMask> mask;
    QString alarm;
    QSize size;  ///< the screen's size
    PictureCaption caption;
    QDateTime taken;  ///< when the bench took the capture; for a file, when this copy was made
};
[[nodiscard]] ScopeStill stillOf(const ScopeModel& model, const ScopeScreen& screen, const PictureCaption& caption);

/// Saves in the format of the path's ending: .png (twice the screen's resolution), .svg or .pdf; large enough for
/// screen and caption. Returns an error as one sentence.
[[nodiscard]] std::optional<QString> saveScopePicture(const ScopeStill& still, const QString& path);
[[nodiscard]] QImage scopePicture(const ScopeStill& still);

}  // namespace tacto::gui
