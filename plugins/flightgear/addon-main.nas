# The radar channel of fanbeam live inside FlightGear: sends position and weather, shows the pictures.
#
# Properties below /fanbeam, to be set before with --prop: or while it runs:
#   http     "http://127.0.0.1:8416"  where fanbeam live shows its page
#   port     5502                     where it listens (--from fg-generic:5502)
#   rate-hz  30                       lines a second; FlightGear sends one a display frame at most
#   scope    "bscope" or "cscope";    gain-dB, frozen, shown
# and told:
#   pictures   how many arrived;    failed   how many did not within five seconds and ten display frames
#
# What has to live as long as the add-on stands out here: a timer that only a function holds is
# collected and never fires.
var config = props.globals.getNode("/fanbeam", 1);
var channel = "fanbeam";
var listeners = [];
var timer = nil;
var window = nil;
var root = nil;
var shown = nil;        # the picture in the window
var asked = nil;        # the one that is on its way, behind it
var asked_s = 0;
var number = 0;

var kSize = [330, 524];  # of the picture in the window
var kPatience_s = 5;
# Nor is a picture late that came while FlightGear itself stood still, loading scenery: it is seen some frames later.
var kLooks = 10;
var looks = 0;

var now_s = func systime();

var defaults = func {
    var set = func(name, value, type) {
        if (config.getNode(name) == nil) config.initNode(name, value, type);
    };
    set("http", "http://127.0.0.1:8416", "STRING");
    set("port", 5502, "INT");
    set("rate-hz", 30, "INT");
    set("scope", "bscope", "STRING");
    set("gain-dB", 0, "DOUBLE");
    set("frozen", 0, "BOOL");
    set("shown", 1, "BOOL");
    config.initNode("pictures", 0, "INT");
    config.initNode("failed", 0, "INT");
};

var open_window = func {
    window = canvas.Window.new(kSize, "dialog");
    window.set("title", "fanbeam radar");
    # Closed by its own button: as if by the menu.
    window.del = func {
        window = nil;
        config.getNode("shown").setBoolValue(0);
        call(canvas.Window.del, [], me);
    };
    root = window.createCanvas().set("background", "#000000").createGroup();
    shown = asked = nil;
};

var close_window = func {
    if (window == nil) return;
    var closing = window;
    window = shown = asked = nil;
    call(canvas.Window.del, [], closing);
};

var follow_shown = func {
    if (config.getNode("shown").getBoolValue()) {
        if (window == nil) open_window();
    } else {
        close_window();
    }
};

# An image that was given no size has that of its file once this has arrived, and none before. One that is
# not visible never gets it.
var arrived = func(image) (image.get("size[0]") or 0) > 0;

# Scaled is the group, which stays: an image that is drawn before it is taken fills the window too.
var take = func {
    root.setScale(kSize[0] / asked.get("size[0]"), kSize[1] / asked.get("size[1]"));
    asked.set("z-index", 1);
    if (shown != nil) shown.del();
    shown = asked;
    asked = nil;
    config.getNode("pictures").setIntValue(config.getNode("pictures").getValue() + 1);
};

var ask = func {
    number += 1;
    asked_s = now_s();
    looks = 0;
    asked = root.createChild("image");
    asked.set("z-index", 0);
    asked.setFile(config.getNode("http").getValue() ~ "/frame/" ~ config.getNode("scope").getValue() ~
        ".png?n=" ~ number ~ "&gain_dB=" ~ config.getNode("gain-dB").getValue());
};

# The next picture is asked for when the last has arrived: a new address cancels a request that has
# not begun.
var look = func {
    if (window == nil) return;
    looks += 1;
    if (asked != nil) {
        if (arrived(asked)) {
            take();
        } elsif (now_s() - asked_s > kPatience_s and looks > kLooks) {
            asked.del();
            asked = nil;
            config.getNode("failed").setIntValue(config.getNode("failed").getValue() + 1);
        } else {
            return;
        }
    }
    if (!config.getNode("frozen").getBoolValue()) ask();
};

var open_channel = func {
    fgcommand("add-io-channel", props.Node.new({
        config: sprintf("generic,socket,out,%d,127.0.0.1,%d,udp,fanbeam",
            config.getNode("rate-hz").getValue(), config.getNode("port").getValue()),
        name: channel,
    }));
};

var begin = func {
    if (timer != nil) return;
    open_channel();
    follow_shown();
    append(listeners, setlistener(config.getNode("shown"), follow_shown));
    timer = maketimer(0, look);  # each display frame
    timer.start();
};

# Runs before there is a flight model.
var main = func(addon) {
    defaults();
    append(listeners, setlistener("/sim/signals/fdm-initialized", func(node) {
        if (node.getBoolValue()) begin();
    }));
};

var unload = func(addon) {
    foreach (var listener; listeners) removelistener(listener);
    listeners = [];
    if (timer != nil) {
        timer.stop();
        timer = nil;
        fgcommand("remove-io-channel", props.Node.new({ name: channel }));
    }
    close_window();
};
