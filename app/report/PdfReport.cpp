#include "app/report/Fonts.h"
#include "app/report/PdfPages.h"
#include "app/report/PdfTable.h"
#include "app/report/Report.h"

namespace tacto {
namespace {

constexpr double kGap = 10;       // between blocks
constexpr double kTextSize = 12;  // 9 pt
constexpr double kFactColumn = 150;
constexpr double kAboveLine = 7;          // space to write on a line
constexpr double kSymbol = 34;            // space for a verdict's shape before its word
constexpr double kHalf = 316;             // two columns of facts with a gutter
constexpr double kBriefFactColumn = 210;  // width in half a page: settings have names longer than their values

class Setter {
public:
    explicit Setter(PdfPages& pages) : pages_(pages) {}

    void operator()(const TitleBlock& block) {
        pages_.advance(pages_.text(0, PdfPages::kWidth, block.title, textFont(26, true), ink::kText) + 2);
        pages_.advance(pages_.text(0, PdfPages::kWidth, block.subtitle, textFont(kTextSize), ink::kQuiet) + kGap);
    }

    void operator()(const VerdictBlock& block) {
        constexpr double kInset = 16, kWordInset = 8, kBelow = 10;
        const QFont wordFont = textFont(22, true);
        const double width = PdfPages::kWidth - 2 * kInset;
        const double head = PdfPages::textHeight(width - kSymbol, block.word, wordFont) + 2 * kWordInset;
        double height = head + 2 * kBelow;
        for (const auto& reason : block.reasons) height += reasonHeight(width, reason);
        pages_.require(height);
        const double top = pages_.y();
        if (auto* painter = pages_.painter()) {
            painter->fillRect(QRectF(0, top, PdfPages::kWidth, height), ink::kWindow);
            painter->fillRect(QRectF(0, top, PdfPages::kWidth, head), block.mark.fill);
        }
        pages_.advance(kWordInset);
        pages_.text(kInset, kSymbol, block.mark.shape, wordFont, block.mark.ink);
        pages_.text(kInset + kSymbol, width - kSymbol, block.word, wordFont, block.mark.ink);
        pages_.advance(top + head + kBelow - pages_.y());
        for (const auto& reason : block.reasons) {
            pages_.text(kInset, 12, "–", textFont(kTextSize), ink::kQuiet);
            pages_.text(kInset + 12, width - 12, reason, textFont(kTextSize), ink::kText);
            pages_.advance(reasonHeight(width, reason));
        }
        pages_.advance(top + height - pages_.y() + kGap);
    }

    void operator()(const HeadingBlock& block) {
        const QFont font = textFont(17, true);
        constexpr double kAbove = 10, kBelow = 6;
        const double height = PdfPages::textHeight(PdfPages::kWidth, block.text, font) + kBelow;
        pages_.require(kAbove + height + keepWithNext_);
        if (!pages_.atTop()) pages_.advance(kAbove);
        pages_.text(0, PdfPages::kWidth, block.text, font, ink::kText);
        pages_.advance(height);
    }

    void operator()(const ParagraphBlock& block) {
        const QFont font = textFont(kTextSize);
        pages_.require(PdfPages::textHeight(PdfPages::kWidth, block.text, font));
        pages_.advance(pages_.text(0, PdfPages::kWidth, block.text, font, block.quiet ? ink::kQuiet : ink::kText) +
                       kGap);
    }

    /// Prints short facts in two columns, the first column first; prints other facts and hashes over the whole width.
    void operator()(const FactsBlock& block) {
        std::vector<const ReportFact*> brief, wide;
        for (const auto& fact : block.facts) {
            const double width = QFontMetricsF(textFont(kTextSize)).horizontalAdvance(fact.value);
            const bool isWide = block.oneColumn || fact.isHash || fact.isOpen || width > kHalf - kBriefFactColumn;
            (isWide ? wide : brief).push_back(&fact);
        }
        const std::size_t rows = (brief.size() + 1) / 2;
        for (std::size_t r = 0; r < rows; ++r) {
            const ReportFact* right = r + rows < brief.size() ? brief[r + rows] : nullptr;
            const double height = std::max(factHeight(*brief[r], kHalf, kBriefFactColumn),
                                           right != nullptr ? factHeight(*right, kHalf, kBriefFactColumn) : 0);
            pages_.require(height);
            setFact(*brief[r], 0, kHalf, kBriefFactColumn);
            if (right != nullptr) setFact(*right, PdfPages::kWidth - kHalf, kHalf, kBriefFactColumn);
            pages_.advance(height + 3);
        }
        if (!brief.empty() && !wide.empty()) pages_.advance(kGap / 2);
        const double column = brief.empty() ? kFactColumn : kBriefFactColumn;  // values are aligned below each other
        for (const auto* fact : wide) {
            const double height = factHeight(*fact, PdfPages::kWidth, column);
            pages_.require(height);
            setFact(*fact, 0, PdfPages::kWidth, column);
            pages_.advance(height + 3);
        }
        pages_.advance(kGap);
    }

    void operator()(const TableBlock& block) {
        setTable(pages_, block);
        pages_.advance(kGap + 4);
    }

    void operator()(const MatrixBlock& block) {
        setMatrix(pages_, block);
        pages_.advance(kGap + 4);
    }

    void operator()(const FigureBlock& block) {
        pages_.require(figureHeight(block));
        const double top = pages_.y();
        if (auto* painter = pages_.painter()) {
            painter->save();
            painter->translate(0, top);
            block.sheet->paint(*painter);
            painter->restore();
        }
        pages_.advance(block.sheet->size().height() + 4);
        pages_.advance(pages_.text(0, PdfPages::kWidth, block.caption, textFont(kTextSize, true), ink::kText));
        if (!block.legend.isEmpty()) {
            pages_.advance(pages_.text(0, PdfPages::kWidth, block.legend, textFont(11), ink::kQuiet));
        }
        pages_.advance(kGap + 6);
    }

    /// Draws a ruled line for each role, long enough to write on.
    void operator()(const SignaturesBlock& block) {
        constexpr double kLine = 28;
        constexpr double kRoleColumn = 90;
        const auto columns = static_cast<double>(block.columns.size());
        const double width = (PdfPages::kWidth - kRoleColumn) / columns;
        for (qsizetype r = 0; r < block.roles.size(); ++r) {
            const QString& role = block.roles[r];
            pages_.require(kLine + 18);
            pages_.advance(kLine - 18);
            pages_.text(kRoleColumn, width - 14, block.given.value(r), textFont(kTextSize), ink::kText);
            if (r == 0) pages_.text(kRoleColumn + width, width - 14, block.second, textFont(kTextSize), ink::kText);
            pages_.advance(18);
            if (auto* painter = pages_.painter()) {
                painter->setPen(QPen(ink::kQuiet, 0.7));
                for (int c = 0; c < block.columns.size(); ++c) {
                    const double left = kRoleColumn + c * width;
                    painter->drawLine(QPointF(left, pages_.y()), QPointF(left + width - 14, pages_.y()));
                }
            }
            pages_.text(0, kRoleColumn - 10, role, textFont(kTextSize), ink::kText);
            double height = 0;
            for (int c = 0; c < block.columns.size(); ++c) {
                height = pages_.text(kRoleColumn + c * width, width - 14, block.columns[c], textFont(11), ink::kQuiet);
            }
            pages_.advance(height + 4);
        }
        pages_.advance(kGap);
    }

    void operator()(const CodeBlock& block) {
        const QFont font = monoFont(11);
        for (const auto& line : block.lines) {
            const double height = PdfPages::textHeight(PdfPages::kWidth - 20, line, font) + 8;
            pages_.require(height);
            if (auto* painter = pages_.painter()) {
                painter->fillRect(QRectF(0, pages_.y(), PdfPages::kWidth, height), ink::kWindow);
            }
            pages_.advance(4);
            pages_.text(10, PdfPages::kWidth - 20, line, font, ink::kText);
            pages_.advance(height - 4);
        }
        pages_.advance(kGap);
    }

    /// Returns the height that a heading needs below it: the start of blocks[i], and the block after a quiet paragraph.
    static double needOf(const std::vector<ReportBlock>& blocks, std::size_t i) {
        if (i >= blocks.size()) return 0;
        const auto& block = blocks[i];
        if (const auto* figure = std::get_if<FigureBlock>(&block)) return figureHeight(*figure);
        if (const auto* table = std::get_if<TableBlock>(&block)) return tableBeginning(*table);
        if (const auto* matrix = std::get_if<MatrixBlock>(&block)) return matrixBeginning(*matrix);
        if (const auto* paragraph = std::get_if<ParagraphBlock>(&block)) {
            const double height = PdfPages::textHeight(PdfPages::kWidth, paragraph->text, textFont(kTextSize)) + kGap;
            return std::min(PdfPages::kHeight / 2, height + (paragraph->quiet ? needOf(blocks, i + 1) : 0));
        }
        return 90;
    }
    void keepWithNext(double height) { keepWithNext_ = height; }

private:
    static double reasonHeight(double width, const QString& reason) {
        return PdfPages::textHeight(width - 12, reason, textFont(kTextSize));
    }
    static double figureHeight(const FigureBlock& block) {
        double height = block.sheet->size().height() + 4;
        height += PdfPages::textHeight(PdfPages::kWidth, block.caption, textFont(kTextSize, true));
        if (!block.legend.isEmpty()) height += PdfPages::textHeight(PdfPages::kWidth, block.legend, textFont(11));
        return height;
    }

    static double factHeight(const ReportFact& fact, double width, double name) {
        const QFont font = fact.isHash ? monoFont(11) : textFont(kTextSize);
        const double named = PdfPages::textHeight(name - 10, fact.name, textFont(kTextSize));
        if (fact.isOpen) return named + kAboveLine;
        return std::max(PdfPages::textHeight(width - name, fact.value, font, fact.isHash), named);
    }
    void setFact(const ReportFact& fact, double left, double width, double name) {
        if (fact.isOpen) {
            pages_.advance(kAboveLine);
            const double below = pages_.y() + pages_.text(left, name - 10, fact.name, textFont(kTextSize), ink::kQuiet);
            pages_.advance(-kAboveLine);
            if (auto* painter = pages_.painter()) {
                painter->setPen(QPen(ink::kQuiet, 0.7));
                painter->drawLine(QPointF(left + name, below), QPointF(left + width, below));
            }
            return;
        }
        pages_.text(left, name - 10, fact.name, textFont(kTextSize), ink::kQuiet);
        pages_.text(left + name, width - name, fact.value, fact.isHash ? monoFont(11) : textFont(kTextSize), ink::kText,
                    Qt::AlignLeft, fact.isHash);
    }

    PdfPages& pages_;
    double keepWithNext_ = 0;
};

void setAll(const ReportContent& content, PdfPages& pages) {
    Setter setter(pages);
    for (std::size_t i = 0; i < content.blocks.size(); ++i) {
        setter.keepWithNext(Setter::needOf(content.blocks, i + 1));
        std::visit(setter, content.blocks[i]);
    }
}

}  // namespace

Result<void> writePdf(const ReportContent& content, QIODevice& device) {
    // The pages are laid out twice: the first pass counts them.
    PdfPages counting(nullptr, {}, {}, {}, 0);
    setAll(content, counting);
    PdfPages pages(&device, content.documentTitle, content.header, content.footer, counting.page(), content.alarming);
    setAll(content, pages);
    if (!pages.finish()) return fail(ErrorCode::Io, "The report's pages could not be written.");
    return {};
}

}  // namespace tacto
