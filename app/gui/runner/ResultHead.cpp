#include "app/gui/runner/ResultHead.h"

#include <QScrollBar>
#include <utility>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/ScriptPlace.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/report/NumberText.h"
#include "app/report/TableContent.h"
#include "core/base/JsonText.h"
#include "core/dsp/RoughnessFlags.h"
#include "core/session/Origin.h"

namespace tacto::gui {

namespace {

constexpr int kBesideBlock = 16;
constexpr int kMaxBlocks = 3;  // the largest height of the reasons; beyond it they scroll
constexpr int kReadable = 36;  // characters per line of reasons; with less room the reasons go below the verdict

/// Returns a label for a script's words, in plain text, one per line.
QLabel* wordsLabel(const char* name, QWidget* parent) {
    auto* label = makeLabel({}, {.name = name, .wraps = true, .plain = true, .selectable = true}, parent);
    return label;
}

}  // namespace

ResultHead::ResultHead(QWidget* parent) : QWidget(parent) {
    auto* row = new QBoxLayout(QBoxLayout::LeftToRight, this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(kBesideBlock);
    verdict_ = new VerdictBlock(this);
    row->addWidget(verdict_, 0, Qt::AlignTop);
    // Shown in full up to a few lines; beyond that it scrolls, so that the plot keeps its room.
    area_ = new ScrollingPage(this);
    area_->setObjectName("verdictReasons");
    auto* page = new QWidget(area_->viewport());
    auto* column = columnIn(*page, 0);
    why_ = wordsLabel("verdictWhy", page);
    setTextSize(*why_, TextSize::Body, true);
    more_ = wordsLabel("verdictMore", page);
    setTextSize(*more_, TextSize::Small);
    setTone(*more_, Tone::Quiet);
    toScript_ = pageButton(tr("Show the &line in the script"), "toScript",
                           tr("Opens the script with the line marked at which it ended."), page);
    connect(toScript_, &QPushButton::clicked, this, [this] { emit scriptErrorChosen(errorLine_, error_); });
    addAll(*column, {why_, more_});
    column->addStretch();
    area_->hold(page);
    for (auto* ground : {page, area_->viewport()}) ground->setAutoFillBackground(false);  // as the workspace
    row->addWidget(area_, 1, Qt::AlignTop);
    row->addWidget(toScript_, 0, Qt::AlignTop);
    clear();
    onEvent(*this, QEvent::Resize, [this] { giveRoom(); });
}

void ResultHead::clear() {
    word_.clear();
    error_.clear();
    errorLine_ = 0;
    verdict_->setVerdict({});
    why_->clear();
    more_->clear();
    toScript_->hide();
}

void ResultHead::show(const FinishedRun& run) {
    clear();
    const auto& outcome = run.result.outcome;
    auto key = QString::fromStdString(run.result.verdict());
    if (outcome.error && key.isEmpty()) key = "error";
    word_ = verdictStyle(key).word;
    verdict_->setVerdict(key);
    QStringList why;
    if (outcome.error) {
        error_ = inThePast(QString::fromStdString(outcome.error->message));
        const bool saysSo = error_.contains(tr("The output "));
        why << sentence(withoutScriptPlace(error_)) + (saysSo ? QString() : tr(" The output was switched off."));
        toScript_->setToolTip(tr("Opens the script at the line at which it ended: %1.").arg(scriptPlace(error_)));
    }
    // The error of a stopped run is also among its reasons; it is shown once.
    for (const auto& reason : outcome.reasons) {
        if (!outcome.error || reason != outcome.error->message) why << withOhmSigns(withoutScriptPlace(qtext(reason)));
    }
    for (const auto& trouble : run.result.troubles) why << withOhmSigns(withoutScriptPlace(qtext(trouble.message)));
    if (why.isEmpty()) why << tr("The protocol ran to its end; it judges nothing.");
    why_->setText(withSigns(keptTogether(titled(why.takeFirst()))));
    QStringList marks;
    for (const auto& mark : run.result.marks) marks << QString::fromStdString(flagSentence(mark));
    const auto until = qtext(textOr(memberAt(outcome.results, "stored"), "valid_until"));
    if (!until.isEmpty()) {
        const auto before = marks.removeAll(qtext(kNotCalibratedBefore)) > 0;
        marks << (before ? tr("Calibrated until %1; before this run it was not.") : tr("Calibrated until %1."))
                     .arg(until);
    }
    if (!marks.isEmpty()) why << marks.join(' ');
    more_->setText(withSigns(keptTogether(why.join("\n"))));
    more_->setVisible(!why.isEmpty());
    giveRoom();
    errorLine_ = outcome.line;
    // A fault of the bench is no mistake at a line of the script.
    toScript_->setVisible(outcome.error && outcome.line > 0 && !run.result.leftIn);
}

void ResultHead::giveRoom() {
    const int block = verdict_->sizeHint().height();
    const int beside = width() - verdict_->sizeHint().width() - kBesideBlock -
                       (toScript_->isHidden() ? 0 : toScript_->sizeHint().width() + kBesideBlock);
    const bool below = beside < kReadable * fontMetrics().averageCharWidth();
    auto& row = *static_cast<QBoxLayout*>(layout());
    row.setDirection(below ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
    row.setSpacing(below ? kBesideBlock / 2 : kBesideBlock);
    row.setAlignment(area_, below ? Qt::Alignment() : Qt::AlignTop);
    const int wide = below ? width() : beside;
    const int needed = area_->widget()->layout()->totalHeightForWidth(wide);
    const int most = !roomy_ ? block * 3 / 2 : (below ? kMaxBlocks - 1 : kMaxBlocks) * block;
    area_->setFixedHeight(needed > most ? wholeLines(wide, most) : std::max(needed, below ? 1 : block));
}

/// Returns the largest height up to `most` that cuts no line.
int ResultHead::wholeLines(int wide, int most) const {
    const int strong = why_->fontMetrics().lineSpacing(), plain = more_->fontMetrics().lineSpacing();
    const int first = why_->heightForWidth(wide);
    area_->verticalScrollBar()->setSingleStep(plain);
    return first < most ? first + (most - first) / plain * plain : std::max(most / strong, 1) * strong;
}

void ResultHead::setRoomy(bool roomy) {
    if (std::exchange(roomy_, roomy) != roomy) giveRoom();
}

}  // namespace tacto::gui

#include "moc_ResultHead.cpp"
