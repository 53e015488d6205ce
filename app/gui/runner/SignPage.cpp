#include "app/gui/runner/SignPage.h"

#include <QHBoxLayout>
#include <QVBoxLayout>

#include "app/gui/runner/NotesPanel.h"
#include "app/gui/runner/ReportView.h"
#include "app/gui/theme/ElidedLabel.h"
#include "app/gui/theme/LookChange.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kNotesWidth = 260;
}  // namespace

SignPage::SignPage(DayNotes& day, QWidget* parent) : QWidget(parent), maker_(this) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(16);
    auto* left = new QVBoxLayout;
    notes_ = new NotesPanel(day, this);
    boundWidth(*notes_, kNotesWidth);
    left->addWidget(notes_);
    auto* tip =
        new QLabel(tr("These are recorded when a run begins and appear on the first page of its report, beside the "
                      "lines for signatures."),
                   this);
    tip->setWordWrap(true);
    boundWidth(*tip, kNotesWidth);
    setTone(*tip, Tone::Quiet);
    left->addWidget(tip);
    left->addStretch();
    row->addLayout(left);
    view_ = new ReportView(tr("The report appears here after a run."), this);
    row->addWidget(view_, 1);
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
        printed_ = what;
        showState();
    });
    clear();
}

void SignPage::addStateTo(QHBoxLayout& row) {
    drawing_ = new QProgressBar(this);
    drawing_->setRange(0, 0);
    drawing_->setTextVisible(false);
    drawing_->setAccessibleName(tr("Drawing the report"));
    // Where there is little room it is short: a report that is being drawn must not make the page wider.
    drawing_->setMinimumWidth(fontMetrics().averageCharWidth() * 4);
    drawing_->setMaximumWidth(fontMetrics().averageCharWidth() * 14);
    cancel_ = new QPushButton(tr("Cancel the report"), this);
    cancel_->setAutoDefault(false);
    cancel_->setToolTip(tr("The session is complete; its report can be drawn later, under Sessions."));
    connect(cancel_, &QPushButton::clicked, &maker_, &ReportMaker::cancel);
    says_ = new ElidedLabel(this);
    says_->setObjectName("reportState");
    row.addWidget(drawing_);
    row.addWidget(cancel_);
    row.addWidget(says_, 1);
}

QString SignPage::state() const {
    if (!fault_.isEmpty()) return fault_;
    if (maker_.busy()) return tr("Drawing the report…");
    if (!printed_.isEmpty()) return printed_;
    return view_->report().isEmpty() ? QString() : tr("Written as PDF and HTML.");
}

void SignPage::showState() {
    const bool busy = maker_.busy();
    drawing_->setVisible(busy);
    cancel_->setVisible(busy);
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
    printed_.clear();
    view_->clear();
    showState();
}

void SignPage::show(const FinishedRun& run) {
    clear();
    const auto session = QString::fromStdString(run.result.session.string());
    if (session.isEmpty()) return;  // it never began
    if (!run.pdf.empty()) maker_.make(session, QString::fromStdString(run.pdf.string()));
    if (!run.html.empty()) maker_.make(session, QString::fromStdString(run.html.string()));
    showState();
}

}  // namespace tacto::gui

#include "moc_SignPage.cpp"
