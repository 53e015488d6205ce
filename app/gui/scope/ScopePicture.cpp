#include "app/gui/scope/ScopePicture.h"

#include <QRegularExpression>
#include <cmath>

#include "app/gui/scope/ScopeScreen.h"
#include "app/gui/scope/Steps.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kCaptionMargin = 16;  ///< of the caption

/// Parts of a line that belong together stay so: it goes on in another where one ends.
QStringList wrapped(const QString& line, const QFontMetrics& metrics, int width) {
    static const QRegularExpression kBetween(QStringLiteral("(?<=   |\\s·\\s)(?=\\S)"));
    QStringList lines;
    QString now;
    for (const auto& part : line.split(kBetween)) {
        if (!now.isEmpty() && metrics.horizontalAdvance((now + part).trimmed()) > width) {
            lines << now;
            now = QStringLiteral("      ");  // what goes on is indented
        }
        now += part;
    }
    return lines << now;
}

QString zonedText(const QDateTime& time) {
    const auto minutes = time.offsetFromUtc() / 60;
    const auto zone = minutes == 0 ? QString()
                                   : QStringLiteral("%1%2:%3")
                                         .arg(minutes < 0 ? QStringLiteral("−") : QStringLiteral("+"))
                                         .arg(std::abs(minutes) / 60, 2, 10, QLatin1Char('0'))
                                         .arg(std::abs(minutes) % 60, 2, 10, QLatin1Char('0'));
    return QLocale::c().toString(time, "yyyy-MM-dd HH:mm:ss") + " UTC" + zone;
}

QDateTime takenAt(const ScopeModel& model) {
    const auto& shown = model.shown();
    return shown && shown->taken.isValid() ? shown->taken : QDateTime::currentDateTime();
}

/// Words left of the plot's middle; a text element of the plot's layout stands in its middle only.
class CaptionText final : public QCPLayoutElement {
public:
    /// Within `width`.
    CaptionText(QCustomPlot* plot, const QStringList& lines, const QFont& font, int width)
        : QCPLayoutElement(plot), font_(font) {
        for (const auto& line : lines) lines_ << wrapped(line, QFontMetrics(font), width - 2 * kCaptionMargin);
        setLayer("legend");
        setMinimumSize(0, height());
        setMaximumSize(QWIDGETSIZE_MAX, height());
        setMargins(QMargins(kCaptionMargin, 4, kCaptionMargin, 0));
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
    QStringList lines_;
    const QFont font_;
};

/// The picture is drawn by a screen of its own: what is on the window's stays as it is.
std::unique_ptr<ScopeScreen> captioned(const ScopeStill& still) {
    auto picture = std::make_unique<ScopeScreen>(*still.model);
    picture->setAccessibleName(still.caption.title);
    picture->setMask(still.mask);
    picture->setAlarm(still.alarm);
    QStringList lines{still.caption.date};
    lines << still.caption.lines;
    lines.removeAll(QString());
    auto* layout = picture->plotLayout();
    layout->insertRow(0);
    layout->insertRow(1);
    layout->setRowSpacing(0);
    auto* title = new CaptionText(picture.get(), {still.caption.title}, textFont(TextSize::Large, QFont::DemiBold),
                                  still.size.width());
    auto* rest = new CaptionText(picture.get(), lines, textFont(TextSize::Small), still.size.width());
    layout->addElement(0, 0, title);
    layout->addElement(1, 0, rest);
    picture->resize(still.size.width(), still.size.height() + title->height() + rest->height() + 16);
    return picture;
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
                     .arg(shown->capture->samples())
                     .arg(settingText(shown->capture->rate_hz, "S/s"));
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
    caption.date = zonedText(takenAt(model));
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

ScopeStill stillOf(const ScopeModel& model, const ScopeScreen& screen, const ScopeCaption& caption) {
    return {model.still(), screen.mask(), screen.alarm(), screen.size(), caption, takenAt(model)};
}

std::optional<QString> saveScopePicture(const ScopeStill& still, const QString& path) {
    return savePicture(*captioned(still), path);
}

QImage scopePicture(const ScopeStill& still) { return pictureOf(*captioned(still), 2); }

}  // namespace tacto::gui
