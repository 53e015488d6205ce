#include "app/gui/sessions/LabelSaves.h"

#include <utility>

namespace tacto::gui {

LabelSaves::LabelSaves(QObject* parent) : QObject(parent) {}

void LabelSaves::save(const std::filesystem::path& session, const SessionLabels& shown, const SessionLabels& edited,
                      Then then) {
    saves_.start(
        this, [session, shown, edited] { return saveLabels(session, shown, edited); }, std::move(then));
}

}  // namespace tacto::gui

#include "moc_LabelSaves.cpp"
