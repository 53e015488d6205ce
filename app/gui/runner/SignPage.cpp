#include "app/gui/runner/SignPage.h"

#include <QFormLayout>

#include "app/gui/runner/ReportView.h"
#include "app/gui/runner/SigningRow.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/Told.h"
#include "app/gui/theme/ToolRow.h"

namespace tacto::gui {

namespace {
constexpr int kNotesWidth = 260, kBesideWords = 16;
constexpr int kLowestView = 240;  // least height of the view below the words
}  // namespace

SignPage::SignPage(QWidget* parent) : QWidget(parent), maker_(this) {
    auto* row = new TurningRow(
        [this] { return scaledPx(kNotesWidth) + kBesideWords + view_->minimumSizeHint().width(); }, this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(kBesideWords);
    words_ = buildWords();
    row->addWidget(words_);
    view_ = new ReportView(tr("The report appears here after a run."), this);
    row->addWidget(view_, 1);
    connect(row, &TurningRow::turned, this, &SignPage::fitWords);
    onFontChange(*words_, [this] { fitWords(beside_); });
    fitWords(true);
    addStateTo(view_->row());
    connect(&maker_, &ReportMaker::done, this,
            [this](const QString& out) { out.endsWith(".pdf") ? showReport(out) : showState(); });
    const auto note = [this](const QString& why) {
        if (fault_.isEmpty()) fault_ = why;
        showState();
    };
    connect(&maker_, &ReportMaker::failed, this, note);
    connect(view_, &ReportView::unreadable, this, note);
    connect(view_, &ReportView::said, this, [this](const QString& what) {
        said_ = what;
        tell(what);  // also where this page is not in front
        showState();
    });
    clear();
}

QWidget* SignPage::buildWords() {
    auto* holder = new QWidget(this);
    auto* column = columnIn(*holder);
    column->addWidget(
        makeLabel(tr("Print the report and sign in ink, on the lines of its first page; or open it in the PDF "
                     "viewer, sign and save it there. Then note here who signed: the session keeps the name, the time "
                     "and the report’s hash, and Verify tells if the report is changed later."),
                  {.name = "howToSign", .wraps = true}, holder));
    signing_ = new SigningRow(holder);
    makePrimary(*signing_->findChild<QPushButton*>("signReport"));
    connect(signing_, &SigningRow::ended, this, [this](const QString& what) {
        said_ = what;
        showState();
    });
    column->addWidget(signing_);
    named_ = new QWidget(holder);
    auto* named = columnIn(*named_, -1, {0, 8, 0, 0});
    named->addWidget(makeLabel(tr("This report names"), {.size = TextSize::Body, .strong = true}, named_));
    auto* form = new QFormLayout;
    const std::pair<QString, const char*> rows[] = {{tr("Operator"), "namedOperator"},
                                                    {tr("Sample"), "namedSample"},
                                                    {tr("Reviewer"), "namedReviewer"},
                                                    {tr("Ambient"), "namedAmbient"}};
    for (const auto& [title, name] : rows) {
        auto* value = makeLabel({}, {.name = name, .wraps = true, .plain = true}, named_);
        auto* what = makeLabel(title, {.tone = Tone::Quiet}, named_);
        form->addRow(what, value);
        notes_.push_back(value);
    }
    named->addLayout(form);
    named->addWidget(
        makeLabel(tr("As entered under Settings when the run began. For other names enter them there and run "
                     "again."),
                  {.tone = Tone::Quiet, .wraps = true}, named_));
    auto* change = pageButton(tr("Change and run again…"), "changeNotes",
                              tr("Goes to Settings; this report stays as it is."), named_);
    connect(change, &QPushButton::clicked, this, &SignPage::settingsWanted);
    named->addWidget(change, 0, Qt::AlignLeft);
    column->addWidget(named_);
    column->addStretch();
    return holder;
}

bool SignPage::isSigned() const { return !signing_->noted().isEmpty(); }

const QString& SignPage::report() const { return view_->report(); }

void SignPage::offerActs(QMenu& menu) const {
    view_->offerActs(menu);
    if (menu.isEmpty()) menu.addAction(note())->setEnabled(false);
}

void SignPage::fitWords(bool beside) {
    beside_ = beside;
    words_->setMaximumWidth(beside ? scaledPx(kNotesWidth) : QWIDGETSIZE_MAX);
    view_->setMinimumHeight(beside ? 0 : scaledPx(kLowestView));
}

void SignPage::showNotes(const RunNotes* notes) {
    named_->setVisible(notes != nullptr);
    if (notes == nullptr) return;
    const std::string* texts[] = {&notes->operatorName, &notes->sample, &notes->reviewer, &notes->ambient};
    for (std::size_t i = 0; i < notes_.size(); ++i)
        notes_[i]->setText(texts[i]->empty() ? tr("not recorded") : QString::fromStdString(*texts[i]));
}

void SignPage::addStateTo(QHBoxLayout& row) {
    drawing_ = new ProgressBar(this);
    drawing_->setRange(0, 0);
    drawing_->setTextVisible(false);
    drawing_->setAccessibleName(tr("Drawing the report"));
    // If space is short this text is elided: drawing a report must not make the page wider.
    drawing_->setMinimumWidth(fontMetrics().averageCharWidth() * 4);
    drawing_->setMaximumWidth(fontMetrics().averageCharWidth() * 14);
    cancel_ = pageButton(tr("Cancel the report"), {},
                         tr("The session is complete; its report can be drawn later, under Sessions."), this);
    connect(cancel_, &QPushButton::clicked, &maker_, &ReportMaker::cancel);
    says_ = makeLabel<ElidedLabel>({}, {.name = "reportState"}, this);
    row.addWidget(drawing_);
    row.addWidget(cancel_);
    row.addWidget(says_, 1);
}

QString SignPage::state() const {
    if (!fault_.isEmpty()) return fault_;
    if (!said_.isEmpty()) return said_;
    if (maker_.busy()) return tr("Drawing the report…");
    return view_->report().isEmpty() ? QString() : tr("Written as PDF and HTML.");
}

QString SignPage::note() const {
    if (!fault_.isEmpty() || maker_.busy() || view_->report().isEmpty()) return state();
    return isSigned() ? signing_->noted() : tr("Not signed yet");
}

void SignPage::showState() {
    const bool busy = maker_.busy();
    drawing_->setVisible(busy);
    cancel_->setVisible(busy);
    signing_->offer(session_, report(), by_);
    says_->setText(fault_.isEmpty() ? state() : "⚠ " + state());
    says_->setToolTip(says_->text());
    emit stateChanged();
}

void SignPage::showReport(const QString& pdf) {
    view_->show(pdf);
    showState();
}

void SignPage::clear() {
    maker_.cancel();
    fault_.clear();
    said_.clear();
    session_.clear();
    by_.clear();
    showNotes(nullptr);
    view_->clear();
    showState();
}

void SignPage::show(const FinishedRun& run) {
    clear();
    const auto session = QString::fromStdString(run.result.session.string());
    if (session.isEmpty()) return;  // the session did not begin
    session_ = session;
    showNotes(&run.order.notes);
    by_ = qtext(run.order.notes.operatorName);
    if (!run.pdf.empty()) maker_.make(session, QString::fromStdString(run.pdf.string()));
    if (!run.html.empty()) maker_.make(session, QString::fromStdString(run.html.string()));
    showState();
}

}  // namespace tacto::gui

#include "moc_SignPage.cpp"
