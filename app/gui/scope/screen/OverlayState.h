// OverlayState.h - everything that ScopeOverlay draws over the oscilloscope's traces.
//
// Thread-safety: a plain value.
#pragma once

#include <QColor>
#include <QPointF>
#include <QRectF>
#include <QStringList>
#include <optional>
#include <vector>

#include "app/gui/scope/model/ScopeModel.h"
#include "app/gui/scope/model/Trace.h"

namespace tacto::gui {

/// Times are in seconds on the key axis, heights in divisions above the middle.
struct OverlayState {
    struct Lane {
        QString key;
        QString letter;  ///< "V"
        QColor colour;
        double height = 0;
        bool active = false;
        bool right = false;  ///< its handle is at the right edge
    };
    struct Trigger {
        std::optional<double> height;  ///< nothing: the trigger's channel is hidden
        std::optional<double> moment_s;
        std::optional<double> other;                        ///< height of a runt's other threshold
        std::vector<std::pair<double, double>> hysteresis;  ///< heights between which the signal is not judged anew
        std::vector<std::pair<double, double>> began_s{};   ///< when a pulse that triggers now began
        QColor colour;
        bool held = false;  ///< the level follows the commanded amplitude and cannot be dragged
        QString text;       ///< the text shown during a drag
    };
    struct Mark {
        double from_s = 0, to_s = 0;
        QString why;
        QColor colour;
    };
    /// A piece of a trace between two times, with its lowest and highest height.
    struct Drawn {
        double from_s = 0, to_s = 0;
        double low = 0, high = 0;
    };
    /// The values at a time cursor. The flag stands where it hides least of the traces: outside the two cursors, or
    /// between them if there is much more room.
    struct Flag {
        struct Row {
            QString letter;  ///< the lane's letter
            QString text;    ///< "20.1 V ↑"
            QColor colour;
        };
        QString name;      ///< "t₁"
        QString position;  ///< "200.0 µs"
        std::vector<Row> rows;
    };
    /// One lane's curve of the next train, or of the train that manual control would ask for.
    struct Coming {
        std::vector<QPointF> line;  ///< times and heights
        QString text;               ///< "next train 30.7 V" or "by hand: 30.7 V", over the first phase
        QColor colour;
    };
    std::vector<Lane> lanes;
    std::vector<Coming> coming;
    std::optional<Trigger> trigger;
    std::vector<double> timeCursors_s;  ///< two or none
    std::vector<Flag> flags;            ///< the time cursors' flags
    QString timeSpan;                   ///< the time between the time cursors
    std::vector<Drawn> drawn;           ///< pieces of the shown lanes; filled with time cursors only
    std::vector<double> levelCursors;   ///< heights of the level cursors; two or none
    std::vector<QString> levelTexts;    ///< the level cursors' texts: "y₁ 40.0 V"
    QString levelSpan;                  ///< the difference between the level cursors
    int focusedCursor = -1;             ///< 0, 1: time; 2, 3: level
    std::optional<QRectF> box;          ///< the box of a zoom, in pixels
    std::optional<EdgeReading> hover;
    std::vector<Mark> marks;          ///< in time order
    std::vector<MomentMark> moments;  ///< marks on the time axis
    QStringList notes;                ///< about the whole record: "not triggered", "averaged 16"
    QString alarm;                    ///< the message of a failed mask test, until it is acknowledged
};

/// Returns everything except the zoom box and the alarm, which belong to one screen. Uses the current theme.
[[nodiscard]] OverlayState overlayOf(const ScopeModel& model);

}  // namespace tacto::gui
