// ReportContent.h - the report as a sequence of blocks, worded once: PDF and HTML only set them.
//
// Order: title, verdict with its reasons, decision rule and what the verdict rests on, signatures; then the script's
// figures and tables, what was computed from approved trains, events, what was used, how to reproduce.
//
// Thread-safety: the GUI thread (drawn figures are widgets).
#pragma once

#include <QString>
#include <QStringList>
#include <memory>
#include <variant>
#include <vector>

#include "app/report/MatrixBlock.h"
#include "app/report/PlotSheet.h"
#include "app/report/ReportModel.h"
#include "app/report/VerdictMark.h"

namespace tacto {

struct TitleBlock {
    QString title;
    QString subtitle;
};
struct VerdictBlock {
    ReportVerdict verdict = ReportVerdict::None;
    VerdictMark mark;
    QString word;
    QStringList reasons;
};
struct HeadingBlock {
    QString text;
};
struct ParagraphBlock {
    QString text;
    bool quiet = false;
};
struct FactsBlock {
    std::vector<ReportFact> facts;
    bool oneColumn = false;  ///< kept in their order, one below the other
};
struct TableBlock {
    struct Column {
        QString title;
        bool numeric = false;  ///< set to the right
    };
    QString caption;
    std::vector<Column> columns;
    std::vector<QStringList> rows;
    std::size_t naming = 0;  ///< the column that says what a row is about: the first, or the one after the verdict
};
struct FigureBlock {
    QString caption;
    QString legend;
    std::unique_ptr<PlotSheet> sheet;
};
/// Lines to be filled in by hand: who did it, who checked it.
struct SignaturesBlock {
    QStringList roles;    ///< a line each
    QStringList columns;  ///< the titles on it
    QStringList given;    ///< like `roles`: what stands in the first column already; may be empty
    QString second = {};  ///< what stands in the second column of the first role; may be empty
    bool open = false;    ///< leaves room for missing entries, also on a page that is only read
};
struct CodeBlock {
    QStringList lines;
};

using ReportBlock = std::variant<TitleBlock, VerdictBlock, HeadingBlock, ParagraphBlock, FactsBlock, TableBlock,
                                 MatrixBlock, FigureBlock, SignaturesBlock, CodeBlock>;

struct ReportContent {
    QString documentTitle;
    QString header;  ///< running head: what this is
    QString footer;  ///< session and chain head, short
    bool simulated = false;
    bool damaged = false;   ///< the session was altered: said on every page
    bool alarming = false;  ///< the running head is a warning, set where every reader sees it
    std::vector<ReportBlock> blocks;
};

/// Long texts are cut as ShownText.h says.
[[nodiscard]] ReportContent contentOf(const ReportModel& model);

// Numbers the headings, figures and tables of a report, and marks the captions of what is simulated.

class Captions {
public:
    explicit Captions(bool simulated = false) : simulated_(simulated) {}
    /// Whether the tables that follow show something simulated.
    void setSimulated(bool simulated) { simulated_ = simulated; }
    QString figure(const QString& text, bool simulated) { return numbered("Figure", ++figures_, text, simulated); }
    QString table(const QString& text) { return numbered("Table", ++tables_, text, simulated_); }
    HeadingBlock heading(const QString& text) { return {QString("%1  %2").arg(++headings_).arg(text)}; }

private:
    [[nodiscard]] QString numbered(const char* kind, int number, const QString& text, bool simulated) const {
        QString caption = QString("%1 %2. %3").arg(QLatin1String(kind)).arg(number).arg(text);
        if (simulated) caption += " (simulated)";
        return caption;
    }
    bool simulated_;
    int figures_ = 0;
    int tables_ = 0;
    int headings_ = 0;
};

}  // namespace tacto
