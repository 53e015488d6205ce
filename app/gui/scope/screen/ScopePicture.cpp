#include "app/gui/scope/screen/ScopePicture.h"

#include "app/gui/scope/model/Viewport.h"
#include "app/gui/scope/screen/ScopeScreen.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

QDateTime takenAt(const ScopeModel& model) {
    const auto& shown = model.shown();
    return shown && shown->taken.isValid() ? shown->taken : QDateTime::currentDateTime();
}

/// A second screen draws the picture, so that the window's screen does not change.
Still pictured(const ScopeStill& still) {
    auto screen = std::make_shared<ScopeScreen>(*still.model);
    screen->setMask(still.mask);
    screen->setAlarm(still.alarm);
    screen->resize(still.size);
    const auto draw = [screen, model = still.model](QCPPainter& painter) {
        screen->toPainter(&painter, screen->width(), screen->height());
    };
    return {still.size, draw, still.caption, still.caption.title};
}

}  // namespace

QString laneScaleText(const ScopeModel& model, const ScopeLane& lane) {
    return QObject::tr("%1 %2/div").arg(lane.letter, settingText(model.scaleOf(lane).perDivision, lane.unit));
}

QString scalesText(const ScopeModel& model) {
    QStringList parts;
    for (const auto& lane : model.lanes())
        if (lane.shown && !lane.reference()) parts << laneScaleText(model, lane);
    parts << QObject::tr("%1/div").arg(settingText(stepNotBelow(model.viewport().perDivision_s), "s"));
    if (const auto& shown = model.shown()) {
        parts << QObject::tr("%1 samples at %2")
                     .arg(countText(shown->capture->samples()))
                     .arg(settingText(shown->capture->rate_hz, "S/s"));
        if (shown->averaged > 0) parts << QObject::tr("averaged %1").arg(shown->averaged);
        if (shown->capture->untriggered) parts << QObject::tr("not triggered");
    }
    return parts.join(QStringLiteral(" · "));
}

PictureCaption captionOf(const ScopeModel& model, const SessionAbout* bench, const QStringList& more) {
    PictureCaption caption;
    const auto& shown = model.shown();
    caption.title = pictureTitle(QObject::tr("Oscilloscope"), shown && shown->capture->simulated);
    caption.date = pictureDate(takenAt(model));
    if (shown && !shown->source.isEmpty()) {
        caption.lines << shown->source;
    } else if (bench != nullptr) {
        caption.lines << deviceNames(bench->devices);
    }
    caption.lines << scalesText(model) << more;
    return caption;
}

ScopeStill stillOf(const ScopeModel& model, const ScopeScreen& screen, const PictureCaption& caption) {
    return {model.still(), screen.mask(), screen.alarm(), screen.size(), caption, takenAt(model)};
}

std::optional<QString> saveScopePicture(const ScopeStill& still, const QString& path) {
    return savePicture(pictured(still), path);
}

QImage scopePicture(const ScopeStill& still) { return pictureOf(pictured(still), 2); }

}  // namespace tacto::gui
