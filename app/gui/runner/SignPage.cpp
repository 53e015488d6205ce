#include "app/gui/runner/SignPage.h"

#include <QDesktopServices>
#include <QHBoxLayout>
#include <QMenu>
#include <QScreen>
#include <QUrl>
#include <QVBoxLayout>
#include <algorithm>

#include "app/gui/runner/NotesPanel.h"
#include "app/gui/runner/ReportPrinter.h"
#include "app/gui/theme/ElidedLabel.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kNotesWidth = 260;
constexpr double kZoomStep = 1.25, kMinZoom = 0.25, kMaxZoom = 5;
}  // namespace

SignPage::SignPage(DayNotes& day, QWidget* parent) : QWidget(parent), maker_(this), printer_(new ReportPrinter(this)) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(16);
    auto* left = new QVBoxLayout;
    notes_ = new NotesPanel(day, this);
    notes_->setMaximumWidth(scaledPx(kNotesWidth));
    left->addWidget(notes_);
    auto* tip =
        new QLabel(tr("These are recorded when a run begins and appear on the first page of its report, beside the "
                      "lines for signatures."),
                   this);
    tip->setWordWrap(true);
    tip->setMaximumWidth(scaledPx(kNotesWidth));
    setTone(*tip, Tone::Quiet);
    left->addWidget(tip);
    left->addStretch();
    row->addLayout(left);
    auto* right = new QVBoxLayout;
    empty_ = new QLabel(tr("The report appears here after a run."), this);
    empty_->setAlignment(Qt::AlignCenter);
    setTone(*empty_, Tone::Quiet);
    right->addWidget(empty_, 1);
    document_ = new QPdfDocument(this);
    view_ = new QPdfView(this);
    view_->setObjectName("reportView");
    view_->setAccessibleName(tr("Report"));
    view_->setDocument(document_);
    view_->setPageMode(QPdfView::PageMode::MultiPage);
    view_->setZoomMode(QPdfView::ZoomMode::FitToWidth);
    right->addWidget(view_, 1);
    right->addWidget(buildReportRow());
    row->addLayout(right, 1);
    connect(&maker_, &ReportMaker::done, this, [this](const QString& out) {
        out.endsWith(".pdf") ? showReport(out) : showState();
    });
    connect(&maker_, &ReportMaker::failed, this, [this](const QString& why) {
        if (fault_.isEmpty()) fault_ = why;
        showState();
    });
    connect(printer_, &ReportPrinter::said, this, [this](const QString& what) {
        printed_ = what;
        showState();
    });
    clear();
}

QWidget* SignPage::buildReportRow() {
    auto* holder = new QWidget(this);
    auto* row = new QHBoxLayout(holder);
    row->setContentsMargins(0, 0, 0, 0);
    print_ = new QPushButton(tr("Print"), holder);
    print_->setObjectName("printReport");
    print_->setToolTip(
        tr("Prints all pages on the printer that you choose. For some pages, or several copies, open "
           "the report in the PDF viewer."));
    auto* printers = new QMenu(print_);
    connect(printers, &QMenu::aboutToShow, this, [this, printers] { printer_->offer(*printers, report_); });
    print_->setMenu(printers);
    elsewhere_ = new QPushButton(tr("Open in the PDF viewer"), holder);
    elsewhere_->setObjectName("openReport");
    elsewhere_->setToolTip(tr("Opens the PDF with the desktop's program for it, to sign it there."));
    connect(elsewhere_, &QPushButton::clicked, this,
            [this] { QDesktopServices::openUrl(QUrl::fromLocalFile(report_)); });
    drawing_ = new QProgressBar(holder);
    drawing_->setRange(0, 0);
    drawing_->setTextVisible(false);
    drawing_->setAccessibleName(tr("Drawing the report"));
    // Where there is little room it is short: a report that is being drawn must not make the page wider.
    drawing_->setMinimumWidth(fontMetrics().averageCharWidth() * 4);
    drawing_->setMaximumWidth(fontMetrics().averageCharWidth() * 14);
    cancel_ = new QPushButton(tr("Cancel the report"), holder);
    cancel_->setToolTip(tr("The session is complete; its report can be drawn later, under Sessions."));
    connect(cancel_, &QPushButton::clicked, &maker_, &ReportMaker::cancel);
    zoom_ = new QWidget(holder);
    auto* zoomRow = new QHBoxLayout(zoom_);
    zoomRow->setContentsMargins(0, 0, 0, 0);
    zoomRow->setSpacing(0);
    const auto addZoom = [&](const QString& text, const char* name, const QString& tip, auto act) {
        auto* button = new QPushButton(text, zoom_);
        button->setObjectName(name);
        button->setAccessibleName(tip);
        button->setToolTip(tip);
        button->setAutoDefault(false);
        makeQuiet(*button);
        connect(button, &QPushButton::clicked, this, act);
        zoomRow->addWidget(button);
    };
    addZoom("−", "reportSmaller", tr("Smaller"), [this] { zoom(1 / kZoomStep); });
    addZoom(tr("Page width"), "reportWidth", tr("As wide as the page has room"),
            [this] { view_->setZoomMode(QPdfView::ZoomMode::FitToWidth); });
    addZoom("+", "reportLarger", tr("Larger"), [this] { zoom(kZoomStep); });
    says_ = new ElidedLabel(holder);
    says_->setObjectName("reportState");
    for (auto* button : {print_, elsewhere_, cancel_}) button->setAutoDefault(false);
    row->addWidget(print_);
    row->addWidget(elsewhere_);
    row->addWidget(zoom_);
    row->addWidget(drawing_);
    row->addWidget(cancel_);
    row->addWidget(says_, 1);
    return holder;
}

QString SignPage::state() const {
    if (!fault_.isEmpty()) return fault_;
    if (maker_.busy()) return tr("Drawing the report…");
    if (!printed_.isEmpty()) return printed_;
    return report_.isEmpty() ? QString() : tr("The report is written, as PDF and HTML.");
}

void SignPage::showState() {
    const bool busy = maker_.busy();
    for (auto* button : {print_, elsewhere_}) {
        button->setEnabled(!report_.isEmpty());
        button->setVisible(!report_.isEmpty());
    }
    zoom_->setVisible(document_->pageCount() > 0);
    drawing_->setVisible(busy);
    cancel_->setVisible(busy);
    says_->setText(fault_.isEmpty() ? state() : "⚠ " + state());
    says_->setToolTip(says_->text());
    const bool shows = document_->pageCount() > 0;
    view_->setVisible(shows);
    empty_->setVisible(!shows);
    emit stateChanged();
}

/// Read when it is looked at: a long one takes a moment.
void SignPage::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    if (report_.isEmpty() || document_->pageCount() > 0) return;
    showPdf();
    showState();
}

/// From the width that it has now.
void SignPage::zoom(double factor) {
    double now = view_->zoomFactor();
    if (view_->zoomMode() == QPdfView::ZoomMode::FitToWidth) {
        const auto margins = view_->documentMargins();
        const double points = document_->pagePointSize(0).width();
        const double dots = view_->screen()->logicalDotsPerInch() / 72;  // of a point at factor 1
        if (points > 0) now = (view_->viewport()->width() - margins.left() - margins.right()) / (points * dots);
    }
    view_->setZoomMode(QPdfView::ZoomMode::Custom);
    view_->setZoomFactor(std::clamp(now * factor, kMinZoom, kMaxZoom));
}

void SignPage::showReport(const QString& pdf) {
    report_ = pdf;
    if (isVisible()) showPdf();
    showState();
}

void SignPage::showPdf() {
    document_->load(report_);
    if (document_->pageCount() == 0 && fault_.isEmpty())
        fault_ = tr("%1 cannot be shown here. Open it with another program.").arg(report_);
}

void SignPage::clear() {
    maker_.cancel();
    report_.clear();
    fault_.clear();
    printed_.clear();
    document_->close();
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
