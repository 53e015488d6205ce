// PdfPages.h - A4 pages for blocks: page breaks, running header and footer "page x of y", vector text and figures.
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
    static constexpr double kWidth = 656;   ///< width of the text
    static constexpr double kHeight = 996;  ///< height of the text on one page

    /// Draws on `device`; null only counts pages. `total` is printed as "page x of total". `alarming`: the header is a
    /// warning and is printed where every reader sees it.
    PdfPages(QIODevice* device, const QString& title, QString header, QString footer, int total, bool alarming = false);
    /// Returns the painter of the current page with its origin at the top left of the text; null when only counting.
    [[nodiscard]] QCPPainter* painter() noexcept { return painter_ ? painter_.get() : nullptr; }

    [[nodiscard]] double y() const noexcept { return y_; }
    void advance(double height) noexcept { y_ += height; }
    [[nodiscard]] double left() const noexcept { return kHeight - y_; }
    [[nodiscard]] bool atTop() const noexcept { return y_ <= 0; }
    /// Starts a page unless `height` fits on this one; a block taller than a page starts at a page's top. Returns true
    /// if a page was started.
    bool require(double height);
    [[nodiscard]] int page() const noexcept { return page_; }
    /// Ends the last page. Returns false if the device reported an error.
    [[nodiscard]] bool finish();

    /// Draws `text` in lines of `width` at (x, current y) without moving on. Returns the height of the text.
    double text(double x, double width, const QString& text, const QFont& font, const QColor& color,
                Qt::Alignment alignment = Qt::AlignLeft, bool breakAnywhere = false);
    /// Returns the height that text() would take.
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
