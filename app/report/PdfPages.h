// PdfPages.h - A4 pages to set blocks on: breaks, running head and foot with page x of y, text and figures as vectors.
//
// Positions are in 1/96 inch.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QIODevice>
#include <QPdfWriter>
#include <QString>
#include <memory>
#include <optional>
#include <qcustomplot.h>

namespace tacto {

class PdfPages {
public:
    static constexpr double kWidth = 656;   ///< the text's width
    static constexpr double kHeight = 996;  ///< the text's height on one page

    /// Draws on `device`; null only counts pages. `total` is printed as "page x of total". `alarming`: the header is
    /// a warning, set where every reader sees it.
    PdfPages(QIODevice* device, const QString& title, QString header, QString footer, int total, bool alarming = false);
    /// The painter of the current page, its origin at the text's top left; null when only counting.
    [[nodiscard]] QCPPainter* painter() noexcept { return painter_ ? painter_.get() : nullptr; }

    [[nodiscard]] double y() const noexcept { return y_; }
    void advance(double height) noexcept { y_ += height; }
    [[nodiscard]] double left() const noexcept { return kHeight - y_; }
    [[nodiscard]] bool atTop() const noexcept { return y_ <= 0; }
    /// Starts a page unless `height` fits on this one; what is taller than a page starts at a top.
    /// True when a page was begun.
    bool require(double height);
    [[nodiscard]] int page() const noexcept { return page_; }
    /// Ends the last page. False when the device refused.
    [[nodiscard]] bool finish();

    /// Sets `text` in lines of `width` at (x, y of now) without moving on. The value is its height.
    double text(double x, double width, const QString& text, const QFont& font, const QColor& color,
                Qt::Alignment alignment = Qt::AlignLeft, bool breakAnywhere = false);
    /// The height that text() would take.
    [[nodiscard]] static double textHeight(double width, const QString& text, const QFont& font,
                                           bool breakAnywhere = false);

private:
    void furnish();

    std::unique_ptr<QPdfWriter> writer_;
    std::unique_ptr<QCPPainter> painter_;
    QString header_;
    QString footer_;
    int total_;
    bool alarming_;
    int page_ = 1;
    double y_ = 0;
};

}  // namespace tacto
