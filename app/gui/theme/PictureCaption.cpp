#include "app/gui/theme/PictureCaption.h"

#include <QRegularExpression>
#include <cmath>

#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

constexpr int kCaptionAbove = PictureCaption::kMargin, kCaptionBelow = 8;
constexpr int kAxisDigits = 4;

QFont titleFont() { return textFont(TextSize::Large, QFont::DemiBold); }

/// True if drawLines() draws `text` whole; elidedText() and horizontalAdvance() can differ by a pixel.
bool fits(const QString& text, const QFontMetrics& metrics, int width) {
    return metrics.elidedText(text, Qt::ElideRight, width) == text;
}

/// Parts of a line that belong together; the words of one that is wider than `width`.
QStringList partsOf(const QString& line, const QFontMetrics& metrics, int width) {
    static const QRegularExpression kBetween(QStringLiteral("(?<=   |\\s·\\s)(?=\\S)")),
        kWord(QStringLiteral("(?<= )(?=\\S)"));
    QStringList parts;
    for (const auto& part : line.split(kBetween)) {
        if (fits(part.trimmed(), metrics, width))
            parts << part;
        else
            parts << part.split(kWord);
    }
    return parts;
}

/// A line that has no room goes on in another, indented, where one of its parts ends.
QStringList wrapped(const QString& line, const QFontMetrics& metrics, int width) {
    static const QString kIndent(6, ' ');
    static const QRegularExpression kSpaceAtEnd(QStringLiteral("\\s+$"));
    QStringList lines;
    QString now;
    for (const auto& part : partsOf(line, metrics, width - metrics.horizontalAdvance(kIndent))) {
        const auto longer = now + part;
        if (!now.trimmed().isEmpty() && !fits(QString(longer).remove(kSpaceAtEnd), metrics, width)) {
            lines << now.remove(kSpaceAtEnd);
            now = kIndent + part;
        } else {
            now = longer;
        }
    }
    return lines << now;
}

/// Draws the lines from `top` on; returns where they end.
int drawLines(QPainter& painter, const QStringList& lines, const QFont& font, int width, int top) {
    const QFontMetrics metrics(font);
    painter.setFont(font);
    QRect line(PictureCaption::kMargin, top, width - 2 * PictureCaption::kMargin, metrics.lineSpacing());
    for (const auto& text : lines) {
        painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter,
                         metrics.elidedText(text, Qt::ElideRight, line.width()));
        line.translate(0, line.height());
    }
    return line.top();
}

QString boundText(double value) { return settingText(QString::number(value, 'g', kAxisDigits).toDouble(), {}); }

}  // namespace

QString pictureTitle(const QString& title, bool simulated) {
    return simulated ? QObject::tr("%1 · simulated").arg(title) : title;
}

QString pictureDate(const QDateTime& taken) {
    const auto minutes = taken.offsetFromUtc() / 60;
    const auto zone = minutes == 0 ? QString()
                                   : QStringLiteral("%1%2:%3")
                                         .arg(minutes < 0 ? QStringLiteral("−") : QStringLiteral("+"))
                                         .arg(std::abs(minutes) / 60, 2, 10, QLatin1Char('0'))
                                         .arg(std::abs(minutes) % 60, 2, 10, QLatin1Char('0'));
    return QLocale::c().toString(taken, "yyyy-MM-dd HH:mm:ss") + " UTC" + zone;
}

QString deviceNames(const std::vector<SessionDevice>& devices) {
    QStringList names;
    for (const auto& device : devices) {
        auto name = qtext(device.name);
        if (!device.serial.empty()) name += " " + qtext(device.serial);
        if (device.simulated && !name.contains(QObject::tr("simulated"))) name += QObject::tr(" (simulated)");
        names << name;
    }
    return names.join(QStringLiteral(" · "));
}

QString axesText(const QCustomPlot& plot) {
    QStringList parts;
    for (const auto* axes : plot.axisRects()) {
        for (const auto side : {QCPAxis::atBottom, QCPAxis::atLeft, QCPAxis::atRight}) {
            for (const auto* axis : axes->axes(side)) {
                if (!axis->visible() || axis->label().isEmpty()) continue;
                parts << QObject::tr("%1 %2 to %3")
                             .arg(axis->label(), boundText(axis->range().lower), boundText(axis->range().upper));
            }
        }
    }
    return parts.join(QStringLiteral(" · "));
}

CaptionLines::CaptionLines(const PictureCaption& caption, int width) : width_(width) {
    if (caption.empty()) return;
    const QFontMetrics large(titleFont()), small(textFont(TextSize::Small));
    const int room = width - 2 * PictureCaption::kMargin;
    if (!caption.title.isEmpty()) title_ = wrapped(caption.title, large, room);
    for (const auto& line : QStringList{caption.date} + caption.lines)
        if (!line.isEmpty()) rest_ << wrapped(line, small, room);
    height_ = kCaptionAbove + large.lineSpacing() * int(title_.size()) + small.lineSpacing() * int(rest_.size()) +
              kCaptionBelow;
}

void CaptionLines::draw(QPainter& painter) const {
    if (height_ == 0) return;
    painter.setPen(colours().text);
    const int below = drawLines(painter, title_, titleFont(), width_, kCaptionAbove);
    drawLines(painter, rest_, textFont(TextSize::Small), width_, below);
}

}  // namespace tacto::gui
