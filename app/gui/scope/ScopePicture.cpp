#include "app/gui/scope/ScopePicture.h"

#include <QDateTime>
#include <memory>

#include "app/gui/scope/ScopeScreen.h"
#include "app/gui/scope/Steps.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

/// Words left of the plot's middle; a text element of the plot's layout stands in its middle only.
class CaptionText final : public QCPLayoutElement {
public:
    CaptionText(QCustomPlot* plot, const QStringList& lines, const QFont& font)
        : QCPLayoutElement(plot), lines_(lines), font_(font) {
        setLayer("legend");
        setMinimumSize(0, height());
        setMaximumSize(QWIDGETSIZE_MAX, height());
        setMargins(QMargins(16, 4, 16, 0));
    }

    [[nodiscard]] int height() const { return QFontMetrics(font_).lineSpacing() * static_cast<int>(lines_.size()); }

protected:
    void applyDefaultAntialiasingHint(QCPPainter* painter) const override { painter->setAntialiasing(false); }
    void draw(QCPPainter* painter) override {
        const QFontMetrics metrics(font_);
        painter->setFont(font_);
        painter->setPen(colours().text);
        QRect line(rect().left(), rect().top(), rect().width(), metrics.lineSpacing());
        for (const auto& text : lines_) {
            painter->drawText(line, Qt::AlignLeft | Qt::AlignVCenter,
                              metrics.elidedText(text, Qt::ElideRight, line.width()));
            line.translate(0, line.height());
        }
    }

private:
    const QStringList lines_;
    const QFont font_;
};

/// The picture is drawn by a screen of its own: what is on the window's stays as it is.
std::unique_ptr<ScopeScreen> captioned(const ScopeModel& model, const ScopeScreen& screen,
                                       const ScopeCaption& caption) {
    auto picture = std::make_unique<ScopeScreen>(model);
    picture->setAccessibleName(caption.title);
    picture->setMask(screen.mask());
    picture->setAlarm(screen.alarm());
    QStringList lines{caption.date};
    lines << caption.lines;
    lines.removeAll(QString());
    auto* layout = picture->plotLayout();
    layout->insertRow(0);
    layout->insertRow(1);
    layout->setRowSpacing(0);
    auto* title = new CaptionText(picture.get(), {caption.title}, textFont(TextSize::Large, QFont::DemiBold));
    auto* rest = new CaptionText(picture.get(), lines, textFont(TextSize::Small));
    layout->addElement(0, 0, title);
    layout->addElement(1, 0, rest);
    picture->resize(screen.width(), screen.height() + title->height() + rest->height() + 16);
    return picture;
}

}  // namespace

QString laneScalesText(const ScopeModel& model) {
    QStringList parts;
    for (const auto& lane : model.lanes()) {
        if (!lane.shown || lane.reference()) continue;
        parts << QObject::tr("%1 %2/div").arg(lane.letter, settingText(model.scaleOf(lane).perDivision, lane.unit));
    }
    return parts.join(QStringLiteral(" · "));
}

QString scalesText(const ScopeModel& model) {
    QStringList parts;
    if (const auto lanes = laneScalesText(model); !lanes.isEmpty()) parts << lanes;
    parts << QObject::tr("%1/div").arg(settingText(stepNotBelow(model.viewport().perDivision_s), "s"));
    if (const auto& shown = model.shown()) {
        parts << QObject::tr("%1 samples at %2")
                     .arg(shown->capture->samples())
                     .arg(settingText(shown->capture->rate_hz, "Hz"));
        if (shown->averaged > 0) parts << QObject::tr("averaged %1").arg(shown->averaged);
        if (shown->capture->untriggered) parts << QObject::tr("not triggered");
    }
    return parts.join(QStringLiteral(" · "));
}

ScopeCaption captionOf(const ScopeModel& model, const SessionAbout* bench, const QStringList& more) {
    ScopeCaption caption;
    const auto& shown = model.shown();
    const bool simulated = shown && shown->capture->simulated;
    caption.title = simulated ? QObject::tr("Oscilloscope · simulated") : QObject::tr("Oscilloscope");
    caption.date = QLocale::c().toString(QDateTime::currentDateTime(), "yyyy-MM-dd HH:mm:ss");
    if (shown && !shown->source.isEmpty()) {
        caption.lines << shown->source;
    } else if (bench != nullptr) {
        QStringList devices;
        for (const auto& device : bench->devices) {
            auto name = qtext(device.name);
            if (!device.serial.empty()) name += " " + qtext(device.serial);
            if (device.simulated && !name.contains(QObject::tr("simulated"))) name += QObject::tr(" (simulated)");
            devices << name;
        }
        caption.lines << devices.join(QStringLiteral(" · "));
    }
    caption.lines << scalesText(model) << more;
    return caption;
}

std::optional<QString> saveScopePicture(const ScopeModel& model, const ScopeScreen& screen, const ScopeCaption& caption,
                                        const QString& path) {
    return savePicture(*captioned(model, screen, caption), path);
}

QImage scopePicture(const ScopeModel& model, const ScopeScreen& screen, const ScopeCaption& caption) {
    return pictureOf(*captioned(model, screen, caption), 2);
}

}  // namespace tacto::gui
