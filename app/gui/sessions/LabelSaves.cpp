#include "app/gui/sessions/LabelSaves.h"

#include <utility>

namespace tacto::gui {

LabelSaves::LabelSaves(QObject* parent) : QObject(parent) { thread_.setMaxThreadCount(1); }

LabelSaves::~LabelSaves() { thread_.waitForDone(); }

void LabelSaves::save(const std::filesystem::path& session, const SessionLabels& shown, const SessionLabels& edited,
                      Then then) {
    thread_.start([this, session, shown, edited, then = std::move(then)]() mutable {
        QMetaObject::invokeMethod(
            this, [then = std::move(then), done = saveLabels(session, shown, edited)] { then(done); },
            Qt::QueuedConnection);
    });
}

}  // namespace tacto::gui

#include "moc_LabelSaves.cpp"
