#include "app/gui/runner/ReportView.h"

#include <QFile>
#include <QFileInfo>
#include <QMenu>
#include <QScreen>
#include <algorithm>

#include "app/gui/runner/ReportPrinter.h"
#include "app/gui/runner/SigningRow.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/ToolRow.h"
#include "core/base/WholeFile.h"

namespace tacto::gui {

namespace {
constexpr double kZoomStep = 1.25, kMinZoom = 0.25, kMaxZoom = 5;
constexpr int kLinesApart = 8;
}  // namespace

ReportView::ReportView(const QString& empty, QWidget* parent)
    : QWidget(parent),
      empty_(new QLabel(empty, this)),
      document_(new QPdfDocument(this)),
      view_(new QPdfView(this)),
      printer_(new ReportPrinter(this)) {
    auto* column = columnIn(*this);
    empty_->setAlignment(Qt::AlignCenter);
    empty_->setWordWrap(true);
    setTone(*empty_, Tone::Quiet);
    column->addWidget(empty_, 1);
    nameWidget(*view_, "reportView", tr("Report"));
    view_->setDocument(document_);
    view_->setPageMode(QPdfView::PageMode::MultiPage);
    view_->setZoomMode(QPdfView::ZoomMode::FitToWidth);
    column->addWidget(view_, 1);
    column->addWidget(buildRow());
    connect(printer_, &ReportPrinter::said, this, &ReportView::said);
    offer();
    onEvent(*this, QEvent::Show, [this] {
        if (report_.isEmpty() || document_->pageCount() > 0) return;
        read();
        offer();
    });
}

QWidget* ReportView::buildRow() {
    auto* holder = new QWidget(this);
    auto* acts = new QHBoxLayout;
    auto* more = new QHBoxLayout;
    row_ = new QHBoxLayout;
    auto* lines = new TurningRow(
        [this, acts, more] {
            return acts->sizeHint().width() + more->sizeHint().width() + row_->minimumSize().width() + 2 * kLinesApart;
        },
        holder);
    lines->setContentsMargins(0, 0, 0, 0);
    lines->setSpacing(kLinesApart);
    lines->addLayout(acts);
    lines->addLayout(more);
    lines->addLayout(row_, 1);
    connect(lines, &TurningRow::turned, this, [acts](bool beside) {
        // One below the other, the buttons keep their width.
        acts->setAlignment(beside ? Qt::Alignment() : Qt::AlignLeft);
    });
    print_ = new QPushButton(tr("Print"), holder);
    print_->setObjectName("printReport");
    print_->setToolTip(
        tr("Prints all pages on the printer that you choose. To print some pages or several copies, open the report in "
           "the PDF viewer."));
    auto* printers = new QMenu(print_);
    connect(printers, &QMenu::aboutToShow, this, [this, printers] { printer_->offer(*printers, report_); });
    print_->setMenu(printers);
    auto* save = pageButton(tr("Save as…"), "saveReport", tr("Saves a copy of the report in another place."), holder);
    connect(save, &QPushButton::clicked, this, &ReportView::askSave);
    const auto opens = [this](const QString& text, const char* name, const QString& tip, auto path) {
        auto* button = pageButton(text, name, tip, this);
        connect(button, &QPushButton::clicked, this, [this, path] {
            if (const auto why = openOnDesktop(path()); !why.isEmpty()) emit said(why);
        });
        return button;
    };
    auto* folder = opens(tr("Show in folder"), "folderOfReport", tr("Opens the folder that holds the report."),
                         [this] { return QFileInfo(report_).absolutePath(); });
    auto* viewer =
        opens(tr("Open in the PDF viewer"), "openReport",
              tr("Opens the PDF with the desktop's program for it, to sign it there."), [this] { return report_; });
    acts_ = {print_, save, folder, viewer};
    print_->setAutoDefault(false);
    addAll(*acts, {print_, save});
    addAll(*more, {folder, viewer});
    more->addStretch();
    zoom_ = buildZoom(holder);
    row_->addWidget(zoom_);
    return holder;
}

QWidget* ReportView::buildZoom(QWidget* parent) {
    auto* holder = new QWidget(parent);
    auto* row = rowIn(*holder, 0);
    const auto add = [&](const QString& text, const char* name, const QString& tip, auto act) {
        auto* button = new QPushButton(text, holder);
        nameWidget(*button, name, tip, tip);
        button->setAutoDefault(false);
        makeQuiet(*button);
        connect(button, &QPushButton::clicked, this, act);
        row->addWidget(button);
    };
    add("−", "reportSmaller", tr("Smaller"), [this] { zoom(1 / kZoomStep); });
    add(tr("Page width"), "reportWidth", tr("As wide as the page has room"),
        [this] { view_->setZoomMode(QPdfView::ZoomMode::FitToWidth); });
    add("+", "reportLarger", tr("Larger"), [this] { zoom(kZoomStep); });
    return holder;
}

/// Saves the report as it was when the question was asked.
void ReportView::askSave() {
    QFile file(report_);
    if (!file.open(QIODevice::ReadOnly))
        return emit said(tr("%1 cannot be read: %2.").arg(report_, file.errorString()));
    const FileQuestion question{.title = tr("Save the report"),
                                .wants = FileQuestion::Wants::NewFile,
                                .filters = {tr("Reports (*.pdf)")},
                                .name = QFileInfo(report_).fileName(),
                                .suffix = "pdf"};
    askForFile(*this, question, [this, bytes = file.readAll()](const QString& path) {
        const auto saved = writeWholeFile(path.toStdString(), {bytes.constData(), std::size_t(bytes.size())});
        emit said(saved ? tr("The report is saved to %1.").arg(path)
                        : tr("%1 was not saved: %2. An existing file of that name was not changed.")
                              .arg(path, qtext(saved.error().message)));
    });
}

/// Zooms from the present width.
void ReportView::zoom(double factor) {
    double now = view_->zoomFactor();
    if (view_->zoomMode() == QPdfView::ZoomMode::FitToWidth) {
        const auto margins = view_->documentMargins();
        const double points = document_->pagePointSize(0).width();
        const double dots = view_->screen()->logicalDotsPerInch() / 72;  // dots per point at factor 1
        if (points > 0) now = (view_->viewport()->width() - margins.left() - margins.right()) / (points * dots);
    }
    view_->setZoomMode(QPdfView::ZoomMode::Custom);
    view_->setZoomFactor(std::clamp(now * factor, kMinZoom, kMaxZoom));
}

void ReportView::show(const QString& pdf) {
    document_->close();
    report_ = pdf;
    if (isVisible()) read();
    offer();
}

void ReportView::clear() {
    report_.clear();
    document_->close();
    offer();
}

void ReportView::offerActs(QMenu& menu) const {
    menu.clear();
    if (report_.isEmpty()) return;
    for (auto* button : acts_) {
        if (button == print_)
            printer_->offer(*menu.addMenu(tr("Print")), report_);
        else
            menu.addAction(button->text(), button, &QPushButton::click);
    }
}

void ReportView::read() {
    document_->load(report_);
    if (document_->pageCount() == 0)
        emit unreadable(tr("%1 cannot be shown here. Open it with another program.").arg(report_));
}

void ReportView::offer() {
    const bool shows = document_->pageCount() > 0;
    for (auto* button : acts_) {
        button->setEnabled(!report_.isEmpty());
        button->setVisible(!report_.isEmpty());
    }
    zoom_->setVisible(shows);
    view_->setVisible(shows);
    empty_->setVisible(!shows);
}

namespace {
constexpr int kWideChars = 110, kHighLines = 42;
}

ReportWindow::ReportWindow(const QString& pdf, const QString& session, QWidget* parent)
    : QDialog(parent), view_(new ReportView(tr("The report is not read yet."), this)) {
    setObjectName("reportWindow");
    setWindowTitle(tr("Report %1").arg(QFileInfo(pdf).fileName()));
    auto* column = new QVBoxLayout(this);
    column->addWidget(view_, 1);
    auto* says = new ElidedLabel(pdf, this);
    says->setToolTip(pdf);
    auto* close = new QPushButton(tr("Close"), this);
    close->setAutoDefault(false);
    connect(close, &QPushButton::clicked, this, &QDialog::close);
    view_->row().addStretch();
    view_->row().addWidget(close);
    const auto say = [says](const QString& what) {
        says->setText(what);
        says->setToolTip(what);
    };
    connect(view_, &ReportView::said, says, say);
    connect(view_, &ReportView::unreadable, says, say);
    column->addWidget(says);
    if (!session.isEmpty()) {
        auto* signing = new SigningRow(this);
        signing->offer(session, pdf, {});
        connect(signing, &SigningRow::ended, says, say);
        column->addWidget(signing);
    }
    view_->show(pdf);
    resize(fontMetrics().averageCharWidth() * kWideChars, fontMetrics().height() * kHighLines);
}

void ReportWindow::showReport(QWidget& asking, const QString& pdf, const QString& session) {
    for (auto* other : asking.findChildren<ReportWindow*>()) {
        if (!other->isVisible() || other->view_->report() != pdf) continue;
        other->view_->show(pdf);
        other->raise();
        return other->activateWindow();
    }
    openDialog(new ReportWindow(pdf, session, &asking));
}

}  // namespace tacto::gui

#include "moc_ReportView.cpp"
