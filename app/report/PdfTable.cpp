#include "app/report/PdfTable.h"

#include "app/report/Fonts.h"
#include "app/report/PlotSheet.h"
#include "app/report/VerdictMark.h"

namespace tacto {

namespace {

constexpr double kSize = 11;
constexpr double kHeaderSize = 10;
constexpr double kPadX = 6;
constexpr double kPadY = 2.5;
constexpr double kWidestText = 420;  // longer cells wrap

/// A header has a smaller and lighter font than its cells, as in the window.
QFont cellFont(bool header) { return textFont(header ? kHeaderSize : kSize); }

double widthOf(const QString& text, bool header) {
    double widest = 0;
    for (const auto& line : text.split('\n')) {
        widest = std::max(widest, QFontMetricsF(cellFont(header)).horizontalAdvance(line));
    }
    return widest;
}

/// The ideal width of a column, and its minimum (its longest word).
struct Want {
    double ideal = 0;
    double least = 0;
};

Want wantOf(const TableBlock& table, std::size_t column) {
    Want want;
    const auto include = [&](const QString& text, bool header) {
        want.ideal = std::max(want.ideal, std::min(kWidestText, widthOf(text, header)));
        // Numbers stay on one line with their unit and uncertainty.
        if (table.columns[column].numeric && !header) {
            want.least = std::max(want.least, std::min(kWidestText, widthOf(text, header)));
            return;
        }
        for (const auto& word : text.split(' '))
            want.least = std::max(want.least, std::min(150.0, widthOf(word, header)));
    };
    include(table.columns[column].title, true);
    for (const auto& row : table.rows) include(row.value(static_cast<qsizetype>(column)), false);
    want.ideal += 2 * kPadX + 1;
    want.least += 2 * kPadX + 1;
    return want;
}

struct Part {
    std::vector<std::size_t> columns;
    std::vector<double> widths;
};

/// Splits the columns into parts that fit the page's width; each part repeats the column that names the rows.
std::vector<Part> partsOf(const TableBlock& table) {
    const std::size_t naming = table.naming < table.columns.size() ? table.naming : 0;
    std::vector<Want> wants;
    for (std::size_t i = 0; i < table.columns.size(); ++i) wants.push_back(wantOf(table, i));
    std::vector<Part> parts(1);
    double used = 0;
    for (std::size_t i = 0; i < wants.size(); ++i) {
        if (used + wants[i].least > PdfPages::kWidth && parts.back().columns.size() > 1) {
            parts.emplace_back();
            parts.back().columns.push_back(naming);
            used = wants[naming].least;
        }
        parts.back().columns.push_back(i);
        used += wants[i].least;
    }
    for (auto& part : parts) {
        double least = 0, ideal = 0;
        for (const auto column : part.columns) {
            least += wants[column].least;
            ideal += wants[column].ideal;
        }
        const double room = std::max(0.0, PdfPages::kWidth - least);
        const double share = ideal > least ? std::min(1.0, room / (ideal - least)) : 0;
        for (const auto column : part.columns) {
            part.widths.push_back(wants[column].least + share * (wants[column].ideal - wants[column].least));
        }
        // A single column may still be too wide; it is wrapped to the page width.
        for (auto& width : part.widths) width = std::min(width, PdfPages::kWidth);
    }
    return parts;
}

class TableSetter {
public:
    TableSetter(PdfPages& pages, const TableBlock& table, const Part& part)
        : pages_(pages), table_(table), part_(part) {
        for (const double column : part.widths) width_ += column;
    }

    [[nodiscard]] double width() const { return width_; }
    [[nodiscard]] double headerHeight() const {
        return heightOf([&](std::size_t c) { return table_.columns[c].title; }, true);
    }
    [[nodiscard]] double rowHeight(std::size_t row) const {
        return heightOf([&](std::size_t c) { return table_.rows[row].value(static_cast<qsizetype>(c)); }, false);
    }
    [[nodiscard]] double wholeHeight() const {
        double height = headerHeight();
        for (std::size_t r = 0; r < table_.rows.size(); ++r) height += rowHeight(r);
        return height;
    }

    void setHeader(double left = 0) {
        setCells(
            left, [&](std::size_t c) { return table_.columns[c].title; }, true);
        rule(left, ink::kLine, 1);
    }
    void setRow(std::size_t row, bool last, double left = 0) {
        setCells(
            left, [&](std::size_t c) { return table_.rows[row].value(static_cast<qsizetype>(c)); }, false);
        rule(left, last ? ink::kLine : ink::kGrid, 0.8);
    }

private:
    template <class Text>
    [[nodiscard]] double heightOf(Text text, bool header) const {
        double height = 0;
        for (std::size_t i = 0; i < part_.columns.size(); ++i) {
            height = std::max(
                height, PdfPages::textHeight(part_.widths[i] - 2 * kPadX, text(part_.columns[i]), cellFont(header)));
        }
        return height + 2 * kPadY;
    }

    template <class Text>
    void setCells(double x, Text text, bool header) {
        const double height = heightOf(text, header);
        pages_.advance(kPadY);
        for (std::size_t i = 0; i < part_.columns.size(); ++i) {
            const auto column = part_.columns[i];
            pages_.text(x + kPadX, part_.widths[i] - 2 * kPadX, text(column), cellFont(header),
                        header ? ink::kQuiet : ink::kText,
                        table_.columns[column].numeric ? Qt::AlignRight : Qt::AlignLeft);
            x += part_.widths[i];
        }
        pages_.advance(height - kPadY);
    }

    void rule(double left, const QColor& color, double thickness) {
        auto* painter = pages_.painter();
        if (painter == nullptr) return;
        painter->setPen(QPen(color, thickness));
        painter->drawLine(QPointF(left, pages_.y()), QPointF(left + width_, pages_.y()));
    }

    PdfPages& pages_;
    const TableBlock& table_;
    const Part& part_;
    double width_ = 0;
};

constexpr std::size_t kLong = 24;  // from this number of rows on, a narrow table is set in columns side by side
constexpr double kColumnGap = 26;
constexpr std::size_t kMinRows = 3;  // rows that stay together with the header, and with the last row

double setCaption(PdfPages& pages, const QString& caption, bool draw) {
    const QFont font = textFont(12, true);
    const double height = PdfPages::textHeight(PdfPages::kWidth, caption, font) + 4;
    if (draw) {
        pages.text(0, PdfPages::kWidth, caption, font, ink::kText);
        pages.advance(height);
    }
    return height;
}

/// Returns the height needed at the table's top: all of a short table, a few rows of a long one.
double beginningOf(const TableSetter& setter, double caption, std::size_t rows) {
    const double whole = caption + setter.wholeHeight();
    if (whole < PdfPages::kHeight / 4) return whole;
    double start = caption + setter.headerHeight();
    for (std::size_t r = 0; r < std::min(kMinRows, rows); ++r) start += setter.rowHeight(r);
    return start;
}

void setDown(PdfPages& pages, TableSetter& setter, const QString& caption, std::size_t rows) {
    pages.require(beginningOf(setter, setCaption(pages, caption, false), rows));
    setCaption(pages, caption, true);
    setter.setHeader();
    for (std::size_t r = 0; r < rows; ++r) {
        double together = setter.rowHeight(r);
        if (rows > kMinRows && r + kMinRows == rows) {
            for (std::size_t last = r + 1; last < rows; ++last) together += setter.rowHeight(last);
        }
        if (pages.require(together)) {
            setCaption(pages, caption + ", continued", true);
            setter.setHeader();
        }
        setter.setRow(r, r + 1 == rows);
    }
}

/// Fills the first column of the page with rows, then the next.
void setSideBySide(PdfPages& pages, TableSetter& setter, const QString& caption, std::size_t rows,
                   std::size_t columns) {
    double row = 0;
    for (std::size_t r = 0; r < rows; ++r) row = std::max(row, setter.rowHeight(r));
    QString title = caption;
    for (std::size_t first = 0; first < rows;) {
        const double head = setCaption(pages, title, false) + setter.headerHeight();
        pages.require(head + double(kMinRows) * row);
        const auto fitting = std::max<std::size_t>(1, static_cast<std::size_t>((pages.left() - head - 1) / row));
        const std::size_t down = std::min(fitting, (rows - first + columns - 1) / columns);
        setCaption(pages, title, true);
        const double top = pages.y();
        double bottom = top;
        for (std::size_t column = 0; column < columns && first < rows; ++column) {
            pages.advance(top - pages.y());
            const double left = double(column) * (setter.width() + kColumnGap);
            setter.setHeader(left);
            for (std::size_t i = 0; i < down && first < rows; ++i, ++first) {
                setter.setRow(first, i + 1 == down || first + 1 == rows, left);
            }
            bottom = std::max(bottom, pages.y());
        }
        pages.advance(bottom - pages.y());
        title = caption + ", continued";
    }
}

}  // namespace

double tableBeginning(const TableBlock& table) {
    PdfPages none(nullptr, {}, {}, {}, 0);
    const auto parts = partsOf(table);
    const TableSetter setter(none, table, parts.front());
    return beginningOf(setter, setCaption(none, table.caption, false), table.rows.size());
}

void setTable(PdfPages& pages, const TableBlock& table) {
    const auto parts = partsOf(table);
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const QString caption = p == 0 ? table.caption : table.caption + ", further columns";
        TableSetter setter(pages, table, parts[p]);
        const auto beside =
            static_cast<std::size_t>((PdfPages::kWidth + kColumnGap) / std::max(1.0, setter.width() + kColumnGap));
        if (table.rows.size() > kLong && beside > 1) {
            setSideBySide(pages, setter, caption, table.rows.size(), beside);
        } else {
            setDown(pages, setter, caption, table.rows.size());
        }
        if (p + 1 < parts.size()) pages.advance(10);
    }
}

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
        // Cells are sized first: a title may wrap, but a number may not.
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

    /// Returns the height of caption, header and three rows.
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

    /// Breaks the line before ± if the cell is too narrow, then before the unit; never within a number.
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

    /// Returns a smaller font if the cell is too narrow, because a number must not be broken.
    [[nodiscard]] QFont mainFont(const MatrixBlock::Cell& cell) const {
        const QFont font = textFont(kMainSize, standsOut(cell.state));
        const bool fits = QFontMetricsF(font).horizontalAdvance(cell.main) <= cell_ - 2 * kPad;
        return fits ? font : textFont(kDetailSize, standsOut(cell.state));
    }

    /// The legend is below the last row, on the same page.
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
    // Like any table, a matrix shorter than a quarter of a page is not split.
    const double whole = setter.whole();
    pages.require(whole < PdfPages::kHeight / 4 ? whole : setter.beginning());
    setter.set();
}

}  // namespace tacto
