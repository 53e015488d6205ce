#include "app/gui/scope/ScopeFiles.h"

#include <QClipboard>
#include <QFile>
#include <QGuiApplication>
#include <QMenu>
#include <QTemporaryDir>

#include "app/gui/scope/measurements/MeasurementTable.h"
#include "app/gui/scope/model/CapturePipe.h"
#include "app/gui/scope/screen/ScopeScreen.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Text.h"
#include "app/run/CaptureFormatsList.h"

namespace tacto::gui {

namespace {

constexpr std::size_t kMaxCopied = 200'000;  ///< most samples per channel that are copied as text

/// The visible part, on the session's time base.
std::pair<double, double> visible(const ScopeModel& model) {
    return {model.viewport().left_s + model.zero_s(), model.viewport().right_s() + model.zero_s()};
}

}  // namespace

ScopeFiles::ScopeFiles(CapturePipe& pipe, ScopeModel& model, QWidget& window)
    : pipe_(pipe), model_(model), window_(window), menu_(new QMenu(&window)) {
    menu_->setToolTipsVisible(true);
    menu_->addAction(tr("Open a capture…"), this, &ScopeFiles::askOpen);
    menu_->addSeparator();
    menu_->addAction(tr("Copy picture"), this, &ScopeFiles::copyPicture);
    menu_->addAction(tr("Copy visible data"), this, &ScopeFiles::copyData);
    menu_->addAction(tr("Copy measurements"), this,
                     [this] { QGuiApplication::clipboard()->setText(table_->asText()); });
    menu_->addSeparator();
    auto* png = menu_->addAction(tr("Save picture as PNG…"), this, &ScopeFiles::askSavePicture);
    png->setToolTip(tr("Ctrl+S"));
    menu_->addAction(tr("Save picture as SVG…"), this, [this] { askSave(tr("SVG drawing (*.svg)"), "svg"); });
    menu_->addAction(tr("Save picture as PDF…"), this, [this] { askSave(tr("PDF document (*.pdf)"), "pdf"); });
    menu_->addAction(tr("Save visible data as CSV…"), this, &ScopeFiles::askSaveData);
    connect(&pipe_, &CapturePipe::saved, this,
            [this](const QString& path) { emit told(tr("Saved to %1.").arg(path), {}); });
}

void ScopeFiles::show(ScopeScreen& screen, MeasurementTable& table, std::function<PictureCaption()> caption) {
    caption_ = std::move(caption);
    screen_ = &screen;
    table_ = &table;
    screen.setContextMenuPolicy(Qt::CustomContextMenu);
    connect(&screen, &QWidget::customContextMenuRequested, this,
            [this](const QPoint& at) { menu_->popup(screen_->mapToGlobal(at)); });
}

QString ScopeFiles::captureGlobs() {
    QStringList globs;
    for (const auto suffix : captureFormats()->suffixes())
        globs << "*" + QString::fromUtf8(suffix.data(), qsizetype(suffix.size()));
    return globs.join(' ');
}

void ScopeFiles::askOpen() {
    FileQuestion question{.title = tr("Open a capture"),
                          .filters = {tr("Captures (%1)").arg(captureGlobs()), tr("All files (*)")}};
    askForFile(window_, question, [this](const QString& path) { emit openWanted(path); });
}

void ScopeFiles::askSavePicture() { askSave(tr("PNG picture (*.png)"), "png"); }

void ScopeFiles::askSaveData() { askSave(tr("Capture (*.csv)"), "csv"); }

void ScopeFiles::askSave(const QString& filter, const QString& ending) {
    FileQuestion question{.title = tr("Save as %1").arg(ending.toUpper()),
                          .wants = FileQuestion::Wants::NewFile,
                          .filters = {filter},
                          .suffix = ending};
    const auto shown = still();
    question.name = "scope-" + shown.taken.toString("yyyyMMdd-HHmmss") + "." + ending;
    askForFile(window_, question, [this, ending, shown](const QString& path) {
        saveAs(path.endsWith("." + ending, Qt::CaseInsensitive) ? path : path + "." + ending, shown);
    });
}

void ScopeFiles::saveAs(const QString& path, const ScopeStill& still) {
    if (path.endsWith(".csv", Qt::CaseInsensitive)) {
        emit told({}, {});
        const auto [from, to] = visible(*still.model);
        pipe_.save(still.model->shown(), from, to, path);
    } else if (const auto wrong = saveScopePicture(still, path)) {
        emit told({}, *wrong);
    } else {
        emit told(tr("Saved to %1.").arg(path), {});
    }
}

void ScopeFiles::copyPicture() {
    QGuiApplication::clipboard()->setImage(scopePicture(still()));
    emit told(tr("The picture is on the clipboard."), {});
}

void ScopeFiles::copyData() {
    const auto& shown = model_.shown();
    if (!shown) return;
    const auto [from, to] = visible(model_);
    const QTemporaryDir folder;
    const auto path = folder.filePath("copied.csv");
    if ((std::min(to, shown->end_s()) - std::max(from, shown->capture->start_s)) * shown->capture->rate_hz >
        static_cast<double>(kMaxCopied)) {
        emit told({}, tr("More than %1 samples are on the screen, too many to copy: zoom in, or save them as CSV.")
                          .arg(countText(kMaxCopied)));
    } else if (const auto wrong = saveData(*shown, from, to, path)) {
        emit told({}, *wrong);
    } else if (QFile file(path); file.open(QIODevice::ReadOnly)) {
        QGuiApplication::clipboard()->setText(QString::fromUtf8(file.readAll()));
        emit told(tr("The visible data are on the clipboard."), {});
    }
}

}  // namespace tacto::gui

#include "moc_ScopeFiles.cpp"
