#include "app/gui/runner/ResultPanel.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QScrollArea>
#include <QUrl>
#include <QVBoxLayout>

#include "app/gui/look/Look.h"
#include "app/gui/runner/ResultTables.h"

namespace tacto::gui {

VerdictLook verdictLook(const QString& key) {
    const auto& c = colours();
    if (key == "pass") return {"✔", QObject::tr("PASS"), c.good};
    if (key == "fail") return {"✖", QObject::tr("FAIL"), c.amberText};
    if (key == "stopped") return {"■", QObject::tr("STOPPED"), c.amberText};
    if (key == "indeterminate") return {"?", QObject::tr("INDETERMINATE"), c.amberText};
    if (key == "error") return {"✖", QObject::tr("DID NOT RUN TO ITS END"), c.amberText};
    return {"–", QObject::tr("NO VERDICT"), c.text};
}

ResultPanel::ResultPanel(QWidget* parent) : QWidget(parent), maker_(this) {
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    auto* area = new QScrollArea(this);
    area->setWidgetResizable(true);
    area->setFrameShape(QFrame::NoFrame);
    auto* page = new QWidget(area);
    auto* layout = new QVBoxLayout(page);
    empty_ = new QLabel(tr("The verdict, why, and the numbers appear here after a run."), page);
    empty_->setForegroundRole(QPalette::PlaceholderText);
    empty_->setWordWrap(true);
    layout->addWidget(empty_);
    verdict_ = new QLabel(page);
    verdict_->setObjectName("verdict");
    auto font = verdict_->font();
    font.setPointSizeF(font.pointSizeF() * 1.8);
    font.setBold(true);
    verdict_->setFont(font);
    layout->addWidget(verdict_);
    why_ = new QLabel(page);
    why_->setTextFormat(Qt::PlainText);
    why_->setObjectName("verdictWhy");
    why_->setWordWrap(true);
    why_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    layout->addWidget(why_);
    toScript_ = new QPushButton(tr("Show the &line in the script"), page);
    toScript_->setObjectName("toScript");
    toScript_->setToolTip(tr("Opens the script with the line marked at which it ended."));
    toScript_->setAutoDefault(false);
    connect(toScript_, &QPushButton::clicked, this, [this] { emit scriptErrorChosen(errorLine_, error_); });
    layout->addWidget(toScript_, 0, Qt::AlignLeft);
    numbers_ = new ResultTables(page);
    layout->addWidget(numbers_);
    files_ = new QLabel(page);
    files_->setObjectName("sessionPath");
    files_->setWordWrap(true);
    files_->setOpenExternalLinks(true);
    files_->setTextInteractionFlags(Qt::TextBrowserInteraction);
    files_->setToolTip(tr("Everything the run recorded. The link opens its folder."));
    layout->addWidget(files_);
    layout->addStretch();
    area->setWidget(page);
    outer->addWidget(area, 1);
    outer->addWidget(buildReportRow());
    connect(&maker_, &ReportMaker::done, this, [this](const QString& out) {
        const bool pdf = out.endsWith(".pdf");
        if (pdf) report_ = out;
        showReportState(tr("The report is written, as PDF and HTML."));
        if (pdf) emit reportReady(out);
    });
    connect(&maker_, &ReportMaker::failed, this, [this](const QString& why) {
        if (reportFault_.isEmpty()) reportFault_ = why;
        showReportState({});
    });
    clear();
}

QWidget* ResultPanel::buildReportRow() {
    auto* holder = new QWidget(this);
    auto* row = new QHBoxLayout(holder);
    openReport_ = new QPushButton(tr("Open the re&port"), holder);
    openReport_->setToolTip(tr("Shows the PDF, here in the window."));
    connect(openReport_, &QPushButton::clicked, this, [this] { emit reportWanted(report_); });
    drawing_ = new QProgressBar(holder);
    drawing_->setRange(0, 0);
    drawing_->setTextVisible(false);
    drawing_->setAccessibleName(tr("Drawing the report"));
    drawing_->setMaximumWidth(fontMetrics().averageCharWidth() * 14);
    cancelReport_ = new QPushButton(tr("&Cancel the report"), holder);
    cancelReport_->setToolTip(tr("The session is complete; its report can be drawn later, under Sessions."));
    connect(cancelReport_, &QPushButton::clicked, &maker_, &ReportMaker::cancel);
    reportState_ = new QLabel(holder);
    reportState_->setObjectName("reportState");
    reportState_->setWordWrap(true);
    for (auto* button : {openReport_, cancelReport_}) button->setAutoDefault(false);
    row->addWidget(openReport_);
    row->addWidget(drawing_);
    row->addWidget(cancelReport_);
    row->addWidget(reportState_, 1);
    return holder;
}

void ResultPanel::showReportState(const QString& said) {
    const bool busy = maker_.busy();
    openReport_->setEnabled(!report_.isEmpty());
    drawing_->setVisible(busy);
    cancelReport_->setVisible(busy);
    reportState_->setText(!reportFault_.isEmpty() ? "⚠ " + reportFault_ : busy ? tr("Drawing the report…") : said);
}

void ResultPanel::clear() {
    maker_.cancel();
    verdictKey_.clear();
    word_.clear();
    error_.clear();
    errorLine_ = 0;
    for (auto* label : {verdict_, why_, files_}) {
        label->setText({});
        label->hide();
    }
    empty_->show();
    numbers_->show({});
    report_.clear();
    reportFault_.clear();
    showReportState({});
    openReport_->parentWidget()->hide();
    toScript_->hide();
}

void ResultPanel::show(const FinishedRun& run) {
    clear();
    const auto& outcome = run.result.outcome;
    verdictKey_ = QString::fromStdString(run.result.verdict());
    if (outcome.error && verdictKey_.isEmpty()) verdictKey_ = "error";
    const auto look = verdictLook(verdictKey_);
    word_ = look.word;
    verdict_->setText(look.shape + "  " + look.word);
    colour();
    QStringList why;
    for (const auto& reason : outcome.reasons) why << QString::fromStdString(reason);
    if (outcome.error) {
        error_ = QString::fromStdString(outcome.error->message);
        auto sentence = error_;
        if (!sentence.endsWith('.')) sentence += '.';
        why << sentence + tr(" Output is off.");
    }
    for (const auto& trouble : run.result.troubles) why << QString::fromStdString(trouble.message);
    if (outcome.abandoned) {
        why << tr(
            "The script did not end when it was told to and was given up: it cannot reach the bench any more. "
            "Output is off. Restart the program when you can.");
    }
    for (const auto& mark : run.result.marks) why << QString::fromStdString(mark);
    if (why.isEmpty()) why << tr("The protocol ran to its end; it judges nothing.");
    why_->setText(why.join("\n"));
    empty_->hide();
    verdict_->show();
    why_->show();
    errorLine_ = outcome.line;
    toScript_->setVisible(outcome.error && outcome.line > 0);
    numbers_->show(outcome.results);
    const auto session = QString::fromStdString(run.result.session.string());
    if (session.isEmpty()) return;  // it never began
    const auto folder = QUrl::fromLocalFile(QString::fromStdString(run.result.session.parent_path().string()));
    files_->setText(tr("Session: <a href=\"%1\">%2</a>").arg(folder.toString(), session.toHtmlEscaped()));
    files_->show();
    openReport_->parentWidget()->show();
    if (!run.pdf.empty()) maker_.make(session, QString::fromStdString(run.pdf.string()));
    if (!run.html.empty()) maker_.make(session, QString::fromStdString(run.html.string()));
    showReportState({});
}

void ResultPanel::colour() {
    auto palette = this->palette();
    palette.setColor(QPalette::WindowText, verdictLook(verdictKey_).colour);
    verdict_->setPalette(palette);
}

void ResultPanel::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) colour();
}

}  // namespace tacto::gui
