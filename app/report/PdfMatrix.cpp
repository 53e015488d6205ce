#include "app/report/PdfMatrix.h"

#include "app/report/Fonts.h"
#include "app/report/PlotSheet.h"
#include "app/report/VerdictMark.h"

namespace tacto {
namespace {

using State = MatrixBlock::State;

constexpr double kPad = 4;
constexpr double kMainSize = 11;
constexpr double kDetailSize = 8.5;
constexpr double kWidestTitle = 190;
constexpr double kNarrowestTitle = 140;

bool standsOut(State state) { return state == State::Close || state == State::Broken; }

class MatrixSetter {
public:
    MatrixSetter(PdfPages& pages, const MatrixBlock& matrix) : pages_(pages), matrix_(matrix) {
        double widest = kNarrowestTitle;
        for (const auto& row : matrix.rows) {
            for (const auto& [text, size] : {std::pair(row.title, kMainSize), std::pair(row.note, kDetailSize)})
                widest = std::max(widest, QFontMetricsF(textFont(size)).horizontalAdvance(text) + 2 * kPad);
        }
        const double room = PdfPages::kWidth;
        const auto columns = static_cast<double>(matrix.columns.size());
        double cell = 40;
        for (const auto& row : matrix.rows) {
            for (const auto& each : row.cells) cell = std::max(cell, cellWidth(each));
        }
        // The cells come first: a title may wrap, a number may not.
        title_ = std::clamp(room - columns * cell, kNarrowestTitle, std::min(widest, kWidestTitle));
        cell_ = std::min((room - title_) / std::max(1.0, columns), 110.0);
    }

    void set() {
        caption(matrix_.caption);
        header();
        for (std::size_t r = 0; r < matrix_.rows.size(); ++r) {
            const double height = rowHeight(matrix_.rows[r]);
            const bool last = r + 1 == matrix_.rows.size();
            if (pages_.require(height + (last ? legendHeight() : 0))) {
                caption(matrix_.caption + ", continued");
                header();
            }
            row(matrix_.rows[r], height, last);
        }
        if (matrix_.legend.isEmpty()) return;
        pages_.advance(4);
        pages_.advance(pages_.text(0, PdfPages::kWidth, matrix_.legend, textFont(10), ink::kQuiet));
    }

    /// Caption, header and three rows.
    [[nodiscard]] double beginning() const {
        double height =
            PdfPages::textHeight(PdfPages::kWidth, matrix_.caption, textFont(12, true)) + headerHeight() + 8;
        for (std::size_t r = 0; r < std::min<std::size_t>(3, matrix_.rows.size()); ++r)
            height += rowHeight(matrix_.rows[r]);
        return height;
    }
    [[nodiscard]] double whole() const {
        double height = beginning();
        for (std::size_t r = 3; r < matrix_.rows.size(); ++r) height += rowHeight(matrix_.rows[r]);
        return height;
    }

private:
    static double cellWidth(const MatrixBlock::Cell& cell) {
        double width = QFontMetricsF(textFont(kMainSize, standsOut(cell.state))).horizontalAdvance(cell.main);
        for (const auto& line : cell.detail.split('\n'))
            width = std::max(width, QFontMetricsF(textFont(kDetailSize)).horizontalAdvance(line));
        return width + 2 * kPad + 1;
    }

    /// Broken before ± where the cell is too narrow for it, and then before the unit: never within one.
    [[nodiscard]] QString detailOf(const MatrixBlock::Cell& cell) const {
        const QFontMetricsF metrics(textFont(kDetailSize));
        const auto fits = [&](const QString& text) {
            const auto lines = text.split('\n');
            return std::all_of(lines.begin(), lines.end(), [&](const QString& line) {
                return metrics.horizontalAdvance(line) <= cell_ - 2 * kPad;
            });
        };
        QString detail = cell.detail;
        if (!fits(detail)) detail.replace(" ± ", "\n± ");
        if (!fits(detail)) detail.replace(QChar(0x202f), '\n');
        return detail;
    }

    /// Smaller where the cell is too narrow for it: a number is not broken.
    [[nodiscard]] QFont mainFont(const MatrixBlock::Cell& cell) const {
        const QFont font = textFont(kMainSize, standsOut(cell.state));
        const bool fits = QFontMetricsF(font).horizontalAdvance(cell.main) <= cell_ - 2 * kPad;
        return fits ? font : textFont(kDetailSize, standsOut(cell.state));
    }

    /// It stands below the last row, on the same page.
    [[nodiscard]] double legendHeight() const {
        if (matrix_.legend.isEmpty()) return 0;
        return 4 + PdfPages::textHeight(PdfPages::kWidth, matrix_.legend, textFont(10));
    }

    void caption(const QString& text) {
        pages_.advance(pages_.text(0, PdfPages::kWidth, text, textFont(12, true), ink::kText) + 4);
    }

    [[nodiscard]] double headerHeight() const {
        double height = 0;
        for (const auto& column : matrix_.columns)
            height = std::max(height, PdfPages::textHeight(cell_ - 2 * kPad, column, textFont(10)));
        return height + 2 * kPad;
    }

    void header() {
        const double height = headerHeight(), top = pages_.y();
        pages_.advance(kPad);
        for (int c = 0; c < matrix_.columns.size(); ++c)
            pages_.text(title_ + c * cell_ + kPad, cell_ - 2 * kPad, matrix_.columns[c], textFont(10), ink::kQuiet,
                        Qt::AlignRight);
        pages_.advance(top + height - pages_.y());
        rule(ink::kLine, 1);
    }

    [[nodiscard]] double rowHeight(const MatrixBlock::Row& row) const {
        double height = PdfPages::textHeight(title_ - 2 * kPad, row.title, textFont(kMainSize));
        if (!row.note.isEmpty()) height += PdfPages::textHeight(title_ - 2 * kPad, row.note, textFont(kDetailSize));
        for (const auto& cell : row.cells) {
            double own = PdfPages::textHeight(cell_ - 2 * kPad, cell.main, mainFont(cell));
            if (!cell.detail.isEmpty())
                own += PdfPages::textHeight(cell_ - 2 * kPad, detailOf(cell), textFont(kDetailSize));
            height = std::max(height, own);
        }
        return height + 5;
    }

    void row(const MatrixBlock::Row& row, double height, bool last) {
        const double top = pages_.y();
        for (std::size_t c = 0; c < row.cells.size(); ++c) {
            const double x = title_ + static_cast<double>(c) * cell_;
            background(row.cells[c].state, QRectF(x + 1, top + 1, cell_ - 2, height - 2));
        }
        pages_.advance(2.5);
        const double first = pages_.text(kPad, title_ - 2 * kPad, row.title, textFont(kMainSize), ink::kText);
        pages_.advance(first);
        pages_.text(kPad, title_ - 2 * kPad, row.note, textFont(kDetailSize), ink::kQuiet);
        for (std::size_t c = 0; c < row.cells.size(); ++c) {
            pages_.advance(top + 2.5 - pages_.y());
            cell(row.cells[c], title_ + static_cast<double>(c) * cell_);
        }
        pages_.advance(top + height - pages_.y());
        rule(last ? ink::kLine : ink::kGrid, 0.8);
    }

    void cell(const MatrixBlock::Cell& cell, double x) {
        const auto fail = verdictMark("fail");
        const bool broken = cell.state == State::Broken;
        const QColor color = broken ? fail.ink : cell.state == State::Close ? ink::kAmberText : ink::kText;
        pages_.advance(pages_.text(x + kPad, cell_ - 2 * kPad, cell.main, mainFont(cell), color, Qt::AlignRight));
        pages_.text(x + kPad, cell_ - 2 * kPad, detailOf(cell), textFont(kDetailSize), broken ? fail.ink : ink::kQuiet,
                    Qt::AlignRight);
    }

    void background(State state, const QRectF& box) {
        auto* painter = pages_.painter();
        if (painter == nullptr) return;
        if (state == State::Close) painter->fillRect(box, ink::kAmberCell);
        if (state == State::Broken) painter->fillRect(box, verdictMark("fail").fill);
        if (state != State::Open) return;
        painter->setPen(QPen(ink::kHatch, 0.8));
        constexpr double kStep = 6;
        for (double offset = kStep; offset < box.width() + box.height(); offset += kStep) {
            painter->drawLine(
                QPointF(box.left() + std::max(0.0, offset - box.height()), box.top() + std::min(offset, box.height())),
                QPointF(box.left() + std::min(offset, box.width()), box.top() + std::max(0.0, offset - box.width())));
        }
    }

    void rule(const QColor& color, double thickness) {
        auto* painter = pages_.painter();
        if (painter == nullptr) return;
        const double width = title_ + cell_ * static_cast<double>(matrix_.columns.size());
        painter->setPen(QPen(color, thickness));
        painter->drawLine(QPointF(0, pages_.y()), QPointF(width, pages_.y()));
    }

    PdfPages& pages_;
    const MatrixBlock& matrix_;
    double title_ = 0;
    double cell_ = 0;
};

}  // namespace

double matrixBeginning(const MatrixBlock& matrix) {
    PdfPages none(nullptr, {}, {}, {}, 0);
    return MatrixSetter(none, matrix).beginning();
}

void setMatrix(PdfPages& pages, const MatrixBlock& matrix) {
    MatrixSetter setter(pages, matrix);
    // One that takes less than half a page is not split.
    const double whole = setter.whole();
    pages.require(whole < PdfPages::kHeight / 2 ? whole : setter.beginning());
    setter.set();
}

}  // namespace tacto
