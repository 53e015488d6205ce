#include "app/gui/runner/CellLegend.h"

#include <QPainter>

#include "app/gui/runner/LimitMatrixView.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kSampleWide = 24, kSampleHigh = 18, kRowHigh = 22, kBesideSample = 8, kAbove = 10, kBelowTitle = 8;
constexpr int kSampleIcon = 14;

}  // namespace

CellLegend::CellLegend(QWidget* parent)
    : QWidget(parent),
      kinds_{{"pass", false, tr("inside, uncertainty included")},
             {"pass", true, tr("inside, 80\u202f% or more used")},
             {"refused as expected", false, tr("also asked above: refused")},
             {"attention", false, tr("attention, not a failure")},
             {"indeterminate", false, tr("indeterminate")},
             {"fail", false, tr("exceeded")},
             {"not evaluated", false, tr("n.\u00a0e.: not evaluated")},
             {{}, false, tr("not judged on this load")}} {
    QStringList said;
    for (const auto& kind : kinds_) said << kind.words;
    setAccessibleName(tr("How to read a cell"));
    setAccessibleDescription(said.join("; "));
}

QSize CellLegend::sizeHint() const {
    const int title = QFontMetrics(textFont(TextSize::Small, QFont::DemiBold)).height();
    return {0, scaledPx(kAbove) + title + scaledPx(kBelowTitle) + int(kinds_.size()) * scaledPx(kRowHigh)};
}

void CellLegend::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    const auto& c = colours();
    painter.setPen(c.line);
    painter.drawLine(0, 0, width(), 0);
    painter.setFont(textFont(TextSize::Small, QFont::DemiBold));
    painter.setPen(c.text);
    QRect line(0, scaledPx(kAbove), width(), painter.fontMetrics().height());
    painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter, tr("How to read a cell"));
    line = QRect(0, line.bottom() + 1 + scaledPx(kBelowTitle), width(), scaledPx(kRowHigh));
    painter.setFont(textFont(TextSize::Small));
    const int left = scaledPx(kSampleWide) + kBesideSample;
    for (const auto& kind : kinds_) {
        const QRect sample(0, line.top(), scaledPx(kSampleWide), scaledPx(kSampleHigh));
        paintCellGround(painter, sample, kind.verdict, kind.isNear);
        paintCellShape(painter, sample, kind.verdict, kind.isNear, scaledPx(kSampleIcon));
        painter.setPen(c.text);
        painter.drawText(QRect(left, sample.top(), width() - left, sample.height()), Qt::AlignLeft | Qt::AlignVCenter,
                         painter.fontMetrics().elidedText(kind.words, Qt::ElideRight, width() - left));
        line.translate(0, line.height());
    }
}

}  // namespace tacto::gui

#include "moc_CellLegend.cpp"
