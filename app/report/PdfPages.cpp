#include "app/report/PdfPages.h"

#include <QTextLayout>

#include "app/report/Fonts.h"
#include "app/report/PlotSheet.h"
#include "core/base/ProgramVersion.h"

namespace tacto {
namespace {

constexpr int kResolution = 1200;
constexpr double kMargin = 68.85;  // (A4 width of 793.7 - 656) / 2
constexpr double kTop = 64;
// The line height depends only on the type size: a character from another font moves no line.
constexpr double kLineOfSize = 1.26;
constexpr double kBaselineOfSize = 0.95;

/// Lays `text` out in lines; calls `each` with the layout of each line.
double layOut(double width, const QString& text, const QFont& font, Qt::Alignment alignment, bool breakAnywhere,
              const std::function<void(QTextLayout&, double)>& each) {
    double height = 0;
    const double size = font.pixelSize();
    for (const auto& paragraph : text.split('\n')) {
        QTextLayout layout(paragraph, font);
        QTextOption option(alignment);
        option.setWrapMode(breakAnywhere ? QTextOption::WrapAnywhere : QTextOption::WrapAtWordBoundaryOrAnywhere);
        layout.setTextOption(option);
        layout.beginLayout();
        double inner = 0;
        for (QTextLine line = layout.createLine(); line.isValid(); line = layout.createLine()) {
            line.setLineWidth(width);
            line.setPosition(QPointF(0, inner + kBaselineOfSize * size - line.ascent()));
            inner += kLineOfSize * size;
        }
        layout.endLayout();
        if (each) each(layout, height);
        height += inner;
    }
    return height;
}

}  // namespace

PdfPages::PdfPages(QIODevice* device, const QString& title, QString header, QString footer, int total, bool alarming)
    : header_(std::move(header)), footer_(std::move(footer)), total_(total), alarming_(alarming) {
    if (device == nullptr) return;
    writer_ = std::make_unique<QPdfWriter>(device);
    writer_->setResolution(kResolution);
    writer_->setPageSize(QPageSize(QPageSize::A4));
    writer_->setPageMargins(QMarginsF(0, 0, 0, 0));
    writer_->setTitle(title);
    writer_->setCreator(QString("Tactoscope %1").arg(programVersion().version));
    painter_ = std::make_unique<QCPPainter>();
    painter_->begin(writer_.get());
    painter_->scale(kResolution / 96.0, kResolution / 96.0);
    painter_->translate(kMargin, kTop);
    furnish();
}

bool PdfPages::require(double height) {
    if (height <= left() || atTop()) return false;
    ++page_;
    y_ = 0;
    if (writer_) {
        writer_->newPage();
        furnish();
    }
    return true;
}

bool PdfPages::finish() { return painter_ == nullptr || painter_->end(); }

double PdfPages::text(double x, double width, const QString& text, const QFont& font, const QColor& color,
                      Qt::Alignment alignment, bool breakAnywhere) {
    return layOut(width, text, font, alignment, breakAnywhere, [&](QTextLayout& layout, double offset) {
        if (painter_ == nullptr) return;
        painter_->setPen(color);
        layout.draw(painter_.get(), QPointF(x, y_ + offset));
    });
}

double PdfPages::textHeight(double width, const QString& text, const QFont& font, bool breakAnywhere) {
    return layOut(width, text, font, Qt::AlignLeft, breakAnywhere, {});
}

void PdfPages::furnish() {
    const double y = y_;
    const QFont font = textFont(10);
    y_ = -34;
    text(0, kWidth, header_, alarming_ ? textFont(10, true) : font, alarming_ ? ink::kFault : ink::kQuiet);
    y_ = kHeight + 18;
    text(0, kWidth, footer_, font, ink::kQuiet);
    text(0, kWidth, QString("page %1 of %2").arg(page_).arg(total_), font, ink::kQuiet, Qt::AlignRight);
    painter_->setPen(QPen(ink::kGrid, 0.8));
    painter_->drawLine(QPointF(0, -14), QPointF(kWidth, -14));
    painter_->drawLine(QPointF(0, kHeight + 12), QPointF(kWidth, kHeight + 12));
    y_ = y;
}

}  // namespace tacto
