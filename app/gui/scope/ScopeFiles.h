// ScopeFiles.h - the oscilloscope's files and clipboard: the menu that opens, saves and copies.
#pragma once

#include <QObject>
#include <functional>

#include "app/gui/scope/screen/ScopePicture.h"

class QMenu;
class QWidget;

namespace tacto::gui {

class CapturePipe;
class MeasurementTable;
class ScopeModel;
class ScopeScreen;

class ScopeFiles final : public QObject {
    Q_OBJECT
public:
    /// `window` is the parent of menu and dialogs.
    ScopeFiles(CapturePipe& pipe, ScopeModel& model, QWidget& window);
    /// Set before the menu is used; both outlive this. `caption` says what a picture shows.
    void show(ScopeScreen& screen, MeasurementTable& table, std::function<PictureCaption()> caption);
    [[nodiscard]] QMenu* menu() const noexcept { return menu_; }

    /// "*.csv *.sr …": the files that can be opened, for a dialog's filter.
    [[nodiscard]] static QString captureGlobs();
    void askOpen();
    void askSavePicture();
    void copyPicture();
    /// Picture by its ending (.png, .svg, .pdf), or the visible data (.csv, in the background), of what is shown now.
    void saveAs(const QString& path) { saveAs(path, still()); }

signals:
    void openWanted(const QString& path);
    /// A sentence about what was begun, done, or went wrong; an empty one clears what was said.
    void told(const QString& done, const QString& problem);

private:
    /// Saves the picture as it was when the dialog asked, even if the answer comes later.
    void askSave(const QString& filter, const QString& ending);
    void saveAs(const QString& path, const ScopeStill& still);
    [[nodiscard]] ScopeStill still() const { return stillOf(model_, *screen_, caption_()); }
    void copyData();

    CapturePipe& pipe_;
    ScopeModel& model_;
    QWidget& window_;
    QMenu* menu_;
    ScopeScreen* screen_ = nullptr;
    MeasurementTable* table_ = nullptr;
    std::function<PictureCaption()> caption_;
};

}  // namespace tacto::gui
