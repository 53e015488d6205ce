// ScopeFiles.h - the oscilloscope's menu for files and the clipboard: opens, saves and copies.
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
    /// `window` is the parent of the menu and the dialogs.
    ScopeFiles(CapturePipe& pipe, ScopeModel& model, QWidget& window);
    /// Must be called before the menu is used. Both references outlive this. `caption` describes what a picture shows.
    void show(ScopeScreen& screen, MeasurementTable& table, std::function<PictureCaption()> caption);
    [[nodiscard]] QMenu* menu() const noexcept { return menu_; }

    /// The files that can be opened, as a filter for a file dialog: "*.csv *.sr …".
    [[nodiscard]] static QString captureGlobs();
    void askOpen();
    void askSavePicture();
    void askSaveData();
    /// Returns errors as a sentence.
    [[nodiscard]] std::optional<QString> savePicture(const QString& path) const {
        return saveScopePicture(still(), path);
    }
    void copyPicture();
    /// Saves what is shown now: a picture (.png, .svg, .pdf) or, in the background, the visible data (.csv).
    void saveAs(const QString& path) { saveAs(path, still()); }

signals:
    void openWanted(const QString& path);
    /// Reports what was begun or done, or a problem, as a sentence. Empty texts clear the previous report.
    void told(const QString& done, const QString& problem);

private:
    /// Saves the picture as it was when the dialog opened, even if the user answers later.
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
