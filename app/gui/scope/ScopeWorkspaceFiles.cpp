// The oscilloscope's files and clipboard: opening, saving, copying, dropping.
#include <QAction>
#include <QClipboard>
#include <QDragEnterEvent>
#include <QFile>
#include <QGuiApplication>
#include <QMenu>
#include <QMimeData>
#include <QTemporaryDir>

#include "app/gui/look/Dialogs.h"
#include "app/gui/look/PlotPicture.h"
#include "app/gui/scope/MeasurementTable.h"
#include "app/gui/scope/ScopeExport.h"
#include "app/gui/scope/ScopeView.h"
#include "app/gui/scope/ScopeWorkspace.h"
#include "app/run/CaptureFormatsList.h"

namespace tacto::gui {

namespace {

constexpr std::size_t kMaxCopied = 200'000;  ///< samples a channel, as text on the clipboard

}  // namespace

void ScopeWorkspace::buildMenu() {
    menu_ = new QMenu(this);
    menu_->setToolTipsVisible(true);
    menu_->addAction(tr("Open a capture…"), this, &ScopeWorkspace::askOpen);
    menu_->addSeparator();
    menu_->addAction(tr("Copy picture"), this, &ScopeWorkspace::copyPicture);
    menu_->addAction(tr("Copy visible data"), this, &ScopeWorkspace::copyData);
    menu_->addAction(tr("Copy measurements"), this,
                     [this] { QGuiApplication::clipboard()->setText(table_->asText()); });
    menu_->addSeparator();
    menu_->addAction(tr("Save picture as PNG…"), this, [this] { askSave(tr("PNG picture (*.png)"), "png"); });
    menu_->addAction(tr("Save picture as SVG…"), this, [this] { askSave(tr("SVG drawing (*.svg)"), "svg"); });
    menu_->addAction(tr("Save picture as PDF…"), this, [this] { askSave(tr("PDF document (*.pdf)"), "pdf"); });
    menu_->addAction(tr("Save visible data as CSV…"), this, [this] { askSave(tr("Capture (*.csv)"), "csv"); });
}

QString ScopeWorkspace::captureGlobs() {
    QStringList globs;
    for (const auto suffix : captureFormats()->suffixes())
        globs << "*" + QString::fromUtf8(suffix.data(), qsizetype(suffix.size()));
    return globs.join(' ');
}

void ScopeWorkspace::askOpen() {
    FileQuestion question;
    question.title = tr("Open a capture");
    question.filters << tr("Captures (%1)").arg(captureGlobs()) << tr("All files (*)");
    askForFile(*this, question, [this](const QString& path) { openCaptureFile(path); });
}

void ScopeWorkspace::askSave(const QString& filter, const QString& ending) {
    FileQuestion question;
    question.title = tr("Save as %1").arg(ending.toUpper());
    question.wants = FileQuestion::Wants::NewFile;
    question.filters << filter;
    question.suffix = ending;
    question.name = "scope." + ending;
    askForFile(*this, question, [this, ending](const QString& path) {
        saveAs(path.endsWith("." + ending, Qt::CaseInsensitive) ? path : path + "." + ending);
    });
}

void ScopeWorkspace::saveAs(const QString& path) {
    problem_.clear();
    done_.clear();
    if (path.endsWith(".csv", Qt::CaseInsensitive)) {
        const double zero = view_->zero_s();
        pipe_.save(view_->shown(), view_->viewport().left_s + zero, view_->viewport().right_s() + zero, path);
        return;
    }
    if (const auto wrong = savePicture(*view_, path)) {
        problem_ = *wrong;
    } else {
        done_ = tr("Saved %1.").arg(path);
    }
    showState();
}

void ScopeWorkspace::copyPicture() {
    QGuiApplication::clipboard()->setImage(pictureOf(*view_, 2));
    done_ = tr("The picture is on the clipboard.");
    showState();
}

void ScopeWorkspace::copyData() {
    const auto& shown = view_->shown();
    if (!shown) return;
    const double from = view_->viewport().left_s + view_->zero_s(), to = view_->viewport().right_s() + view_->zero_s();
    done_.clear();
    problem_.clear();
    const QTemporaryDir folder;
    const auto path = folder.filePath("copied.csv");
    if ((std::min(to, shown->end_s()) - std::max(from, shown->capture->start_s)) * shown->capture->rate_hz >
        static_cast<double>(kMaxCopied)) {
        problem_ = tr("More than %1 samples are on the screen, too many to copy: zoom in, or save them as CSV.")
                       .arg(kMaxCopied);
    } else if (const auto wrong = saveData(*shown, from, to, path)) {
        problem_ = *wrong;
    } else if (QFile file(path); file.open(QIODevice::ReadOnly)) {
        QGuiApplication::clipboard()->setText(QString::fromUtf8(file.readAll()));
        done_ = tr("The visible data are on the clipboard.");
    }
    showState();
}

void ScopeWorkspace::dragEnterEvent(QDragEnterEvent* event) {
    const auto urls = event->mimeData()->urls();
    if (!urls.isEmpty() && captureFormats()->knowsSuffix(urls.first().toLocalFile().toStdString())) {
        event->acceptProposedAction();
    }
}

void ScopeWorkspace::dropEvent(QDropEvent* event) { openCaptureFile(event->mimeData()->urls().first().toLocalFile()); }

}  // namespace tacto::gui
