#include "app/gui/theme/GrowingDialog.h"

#include <QEvent>
#include <QLayout>
#include <QScreen>
#include <utility>

#include "app/gui/theme/Dialogs.h"

namespace tacto::gui {

namespace {

class ContentGrowth final : public QObject {
public:
    explicit ContentGrowth(QDialog& dialog) : QObject(&dialog), dialog_(dialog) { dialog.installEventFilter(this); }
    bool eventFilter(QObject* /*watched*/, QEvent* event) override {
        const bool changed = event->type() == QEvent::LayoutRequest || event->type() == QEvent::Show;
        if (!changed || std::exchange(queued_, true)) return false;
        const auto turn = [this] {
            queued_ = false;
            grow();
        };
        QMetaObject::invokeMethod(this, turn, Qt::QueuedConnection);
        return false;
    }

private:
    void grow() {
        const auto* layout = dialog_.layout();
        if (layout == nullptr) return;
        auto wanted = dialog_.size().expandedTo(layout->totalMinimumSize());
        if (layout->hasHeightForWidth())
            wanted.setHeight(std::max(wanted.height(), layout->totalHeightForWidth(wanted.width())));
        const auto frame = dialog_.frameGeometry().size() - dialog_.size();
        wanted = wanted.boundedTo((dialog_.screen()->availableSize() - frame).expandedTo(dialog_.size()));
        if (wanted != dialog_.size()) dialog_.resize(wanted);
        const int bottom = dialog_.screen()->availableGeometry().bottom();
        if (dialog_.isVisible() && dialog_.frameGeometry().bottom() > bottom) place(dialog_);
    }
    QDialog& dialog_;
    bool queued_ = false;
};

}  // namespace

void growWithContent(QDialog& dialog) { new ContentGrowth(dialog); }

}  // namespace tacto::gui
