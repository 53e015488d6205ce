// ReportContent.h - the report as a sequence of blocks with all wording; PDF and HTML only lay them out.
//
// Order: title, verdict with its reasons, decision rule and basis of the verdict, signatures; then the script's figures
// and tables, values computed from approved trains, events, devices and settings, how to reproduce.
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
    bool oneColumn = false;  ///< keeps the facts in order, one below the other
};
struct TableBlock {
    struct Column {
        QString title;
        bool numeric = false;  ///< right-aligned
    };
    QString caption;
    std::vector<Column> columns;
    std::vector<QStringList> rows;
    std::size_t naming = 0;  ///< index of the column that names the row: the first, or the one after the verdict
};
struct FigureBlock {
    QString caption;
    QString legend;
    std::unique_ptr<PlotSheet> sheet;
};
/// Lines to fill in by hand: who did it, who checked it.
struct SignaturesBlock {
    QStringList roles;    ///< one line each
    QStringList columns;  ///< titles on each line
    QStringList given;    ///< for each role, the known text of the first column; may be empty
    QString second = {};  ///< the known text of the second column of the first role; may be empty
    bool open = false;    ///< leaves room for missing entries, even on a page that is only read on screen
};
struct CodeBlock {
    QStringList lines;
};

using ReportBlock = std::variant<TitleBlock, VerdictBlock, HeadingBlock, ParagraphBlock, FactsBlock, TableBlock,
                                 MatrixBlock, FigureBlock, SignaturesBlock, CodeBlock>;

struct ReportContent {
    QString documentTitle;
    QString header;  ///< running header: what this is
    QString footer;  ///< session and shortened chain head
    bool simulated = false;
    bool damaged = false;   ///< the session was altered: stated on every page
    bool alarming = false;  ///< the running header is a warning, printed where every reader sees it
    std::vector<ReportBlock> blocks;
};

/// Long texts are shortened as ShownText.h describes.
[[nodiscard]] ReportContent contentOf(const ReportModel& model);

// Numbers the headings, figures and tables of a report, and marks the captions of simulated figures and tables.

class Captions {
public:
    explicit Captions(bool simulated = false) : simulated_(simulated) {}
    /// Sets whether the tables that follow show something simulated.
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
