/* fanbeam in C: a radar scene held open, its conditions set in milliseconds, frames at any pose,
 * either at once (fanbeam_render) or by a thread of the session's own while the caller goes on
 * (fanbeam_submit_pose, fanbeam_latest_frame). bindings/c/example.c shows both; docs/c-api.md tells
 * more.
 *
 * Units are SI, radians and linear power; a name says its unit, and levels in dB and rain in mm/h say
 * so too. Angles are positive to the right and up. Latitude and longitude are WGS 84, heights count
 * from its ellipsoid. Texts are UTF-8 and end with a zero.
 *
 * Pictures are rows of `columns` values, left to right in azimuth:
 *   8-bit grey   the top row is the farthest range (B-scope) or the highest elevation (C-scope)
 *   all others   row 0 is the nearest range cell (B-scope) or the highest elevation (C-scope)
 *
 * Structs begin with their size: set it to sizeof before each use. A later version adds fields at
 * the end alone and still takes the smaller sizes of earlier ones. Set what you do not use to zero
 * (`fanbeam_setup setup = {0}`), `reserved` too.
 *
 * Errors: a function that returns fanbeam_status and fails has changed nothing, neither in the
 * session nor behind its arguments, unless it says otherwise; fanbeam_last_error() then lists every
 * problem. Nothing here aborts, prints, reads the environment or installs handlers, and no exception
 * comes out. NULL is refused wherever a comment does not say what it means.
 *
 * Threads: every function may be called at any time from any thread and from tasks of oneTBB, on one
 * session or several, but for fanbeam_close (and fanbeam_free_layers on the layers it frees): no
 * other call on that session may be under way then or come later. Frames keep the conditions that
 * they began with; the bytes of a frame depend on its conditions, pose and number alone. A forked
 * child has none of the threads: it must exec, or leave by _exit. */
#ifndef FANBEAM_FANBEAM_H
#define FANBEAM_FANBEAM_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define FANBEAM_API __attribute__((visibility("default")))
#else
#define FANBEAM_API
#endif

#ifdef __cplusplus
#define FANBEAM_NOEXCEPT noexcept
extern "C" {
#else
#define FANBEAM_NOEXCEPT
#endif

/* Of this header; those of the library are asked for below. Below 1.0 the minor number counts a
 * change that a program may have to follow. */
#define FANBEAM_VERSION_MAJOR 0
#define FANBEAM_VERSION_MINOR 1
#define FANBEAM_VERSION_PATCH 0
#define FANBEAM_VERSION_NUMBER \
  (10000 * FANBEAM_VERSION_MAJOR + 100 * FANBEAM_VERSION_MINOR + FANBEAM_VERSION_PATCH)

typedef struct fanbeam_session fanbeam_session; /* a scene held open */
typedef struct fanbeam_layers fanbeam_layers;   /* ground truth of one frame */

typedef enum fanbeam_status {
  FANBEAM_OK = 0,
  FANBEAM_NOTHING_NEW = 1,   /* fanbeam_latest_frame alone: no error */
  FANBEAM_BAD_INPUT = -1,    /* an argument, the scene or one of its files */
  FANBEAM_BAD_SIZE = -2,     /* a struct of a size that this version does not know */
  FANBEAM_SHORT_BUFFER = -3, /* of the caller's */
  FANBEAM_STOPPED = -4,      /* after fanbeam_stop */
  FANBEAM_NO_RESOURCES = -5, /* no memory, or no thread to be had */
  FANBEAM_FAULT = -6         /* a fault of fanbeam's own */
} fanbeam_status;

enum { FANBEAM_BSCOPE = 1, FANBEAM_CSCOPE = 2 };

/* What a frame has to say of itself, as bits. */
enum {
  FANBEAM_OUTSIDE_VOLUME = 1, /* a pose the plan was not made for: tens of milliseconds more */
  FANBEAM_BELOW_TERRAIN = 2,  /* the antenna is not above the ground: noise alone, or no C-scope */
  FANBEAM_EMPTY_VIEW = 4      /* nothing was hit */
};

/* "0.1.0", and 10000 major + 100 minor + patch. */
FANBEAM_API const char* fanbeam_version_text(void) FANBEAM_NOEXCEPT;
FANBEAM_API uint32_t fanbeam_version_number(void) FANBEAM_NOEXCEPT;

/* Of this thread's last call that returns fanbeam_status; "" where there is nothing to tell. One
 * problem a line: "scene.toml:12:5: E-RANGE weather.visibility_m = -3: expected 10 to 100000 m", the
 * place where there is one, a code, the field, the value found, what was expected. Warnings begin
 * with W-. The text holds until this thread's next such call. */
FANBEAM_API const char* fanbeam_last_error(void) FANBEAM_NOEXCEPT;
FANBEAM_API const char* fanbeam_last_warnings(void) FANBEAM_NOEXCEPT;

enum { FANBEAM_AS_SCENE = 0, FANBEAM_EXPECTED = 1, FANBEAM_SAMPLE = 2 };

typedef struct fanbeam_setup {
  uint32_t size;
  int32_t threads; /* at most, for a frame: to 1024; 0: as many as the caller's tasks have */
  uint64_t seed;   /* of everything random */
  const char* shipped_folder; /* holds scenes/, sensors/ and materials/: PREFIX/share/fanbeam */
  const char* const* data_folders; /* that exist, searched in this order; NULL: none */
  size_t data_folder_count;        /* at most 256 */
  const char* sensor_file;         /* NULL or "": the scene's */
  const char* effects;     /* "all", "none", "+rain,-gas"; NULL or "": as the scene calls for */
  const char* caster;      /* "rays", "profile", "auto"; NULL or "": the scene's */
  double samples_per_cell; /* as fanbeam_set_samples; 0: as the scene says (a time budget is
                              measured when it is opened) */
  int32_t realisation;     /* FANBEAM_SAMPLE: one draw of speckle and noise; FANBEAM_EXPECTED: the
                              mean of all draws; FANBEAM_AS_SCENE */
  int32_t bscope_alone;    /* 1: no C-scope is ever asked for (it is refused), and effects that none
                              but a C-scope shows are left out: docs/plan.md; 0: both are */
} fanbeam_setup;

/* `scene` is a folder with scene.toml, or that file. Takes seconds. Where it fails *session is NULL,
 * else it is to be closed. */
FANBEAM_API fanbeam_status fanbeam_open(const char* scene, const fanbeam_setup* setup,
                                        fanbeam_session** session) FANBEAM_NOEXCEPT;

/* Ends what is under way within milliseconds and for good: renderings return FANBEAM_STOPPED, and so
 * do all later ones. For a program that wants to end while a thread of its own renders. */
FANBEAM_API fanbeam_status fanbeam_stop(fanbeam_session* session) FANBEAM_NOEXCEPT;

/* Stops the session's thread and frees everything but layers. NULL is nothing to close. */
FANBEAM_API void fanbeam_close(fanbeam_session* session) FANBEAM_NOEXCEPT;

/* Pictures and axes, which stay for the life of a session. Column c has its middle at azimuth
 * ((c + 0.5) / columns - 0.5) field_of_view_rad. */
typedef struct fanbeam_facts {
  uint32_t size;
  uint32_t columns;     /* of both pictures */
  uint32_t bscope_rows; /* range cells */
  uint32_t cscope_rows;
  uint32_t frame_count; /* of the scene's own flight; 0 without one */
  uint32_t reserved;
  double range_minimum_m; /* near edge of the nearest range cell */
  double range_cell_m;
  double field_of_view_rad;
  double cscope_top_rad; /* upper edge */
  double cscope_span_rad;
  double frame_rate_Hz; /* of the sensor: the library renders whenever it is asked to */
  double low_dB;        /* level shown as grey 0 */
  double high_dB;       /* and as grey 255 */
} fanbeam_facts;

FANBEAM_API fanbeam_status fanbeam_get_facts(fanbeam_session* session,
                                             fanbeam_facts* facts) FANBEAM_NOEXCEPT;

typedef struct fanbeam_pose {
  uint32_t size;
  uint32_t reserved;
  double time_s;        /* moves the scene's own targets; any finite one */
  double latitude_rad;  /* -pi/2 to pi/2 */
  double longitude_rad; /* -3 pi to 3 pi */
  double height_m;      /* -20000 to 1e6, and within 1000 km of the scene's origin */
  double roll_rad;      /* right wing down; any finite angle, as the next two */
  double pitch_rad;     /* nose up */
  double heading_rad;   /* clockwise from true north; yaw, pitch, roll are applied in this order */
  double north_mps;     /* over ground; pictures do not depend on it */
  double east_mps;
  double down_mps;
} fanbeam_pose;

/* Of frame 0 to frame_count - 1 of the scene's own flight. */
FANBEAM_API fanbeam_status fanbeam_flown_pose(fanbeam_session* session, uint32_t frame,
                                              fanbeam_pose* pose) FANBEAM_NOEXCEPT;

/* Weather. What `given` does not name stays as it is, and its field is not looked at; layers of fog
 * and cells of rain that the scene has stay too. Takes some milliseconds. */
enum {
  FANBEAM_VISIBILITY = 1, /* fog of visibility_m below the scene's fog top */
  FANBEAM_NO_FOG = 2,     /* none there; not together with FANBEAM_VISIBILITY */
  FANBEAM_RAIN_RATE = 4   /* rain of rain_rate_mm_per_h everywhere; 0: none */
};

typedef struct fanbeam_weather {
  uint32_t size;
  uint32_t given;
  double visibility_m;       /* 10 to 100000 */
  double rain_rate_mm_per_h; /* 0 to 300 */
} fanbeam_weather;

FANBEAM_API fanbeam_status fanbeam_set_weather(fanbeam_session* session,
                                               const fanbeam_weather* weather) FANBEAM_NOEXCEPT;

enum { FANBEAM_ATTITUDE = 1, FANBEAM_RCS = 2 };

/* Where a point scatterer stands until told otherwise; a speed of its own is not modelled. */
typedef struct fanbeam_target {
  uint32_t size;
  uint32_t given;   /* FANBEAM_ATTITUDE, FANBEAM_RCS: else as set before, the scene's, or north */
  const char* name; /* one of the scene's, all that share it; another one is new and needs an rcs */
  double latitude_rad, longitude_rad, height_m; /* as of a pose */
  double roll_rad, pitch_rad, heading_rad;      /* with FANBEAM_ATTITUDE; as of a pose */
  double rcs_m2; /* with FANBEAM_RCS: the same from all sides, 0 to 1e9 */
} fanbeam_target;

/* Sets one and leaves the others; or sets these, all of one size, while the others go back to where
 * the scene has them and new ones vanish (NULL and 0: all do). Some milliseconds a call. */
FANBEAM_API fanbeam_status fanbeam_set_target(fanbeam_session* session,
                                              const fanbeam_target* target) FANBEAM_NOEXCEPT;
FANBEAM_API fanbeam_status fanbeam_set_targets(fanbeam_session* session,
                                               const fanbeam_target* targets,
                                               size_t count) FANBEAM_NOEXCEPT;

/* Rays per range cell and column, or slices per column: 0.3 to 10000, or 0 for the caster's default.
 * Finer pictures take longer. */
FANBEAM_API fanbeam_status fanbeam_set_samples(fanbeam_session* session,
                                               double samples_per_cell) FANBEAM_NOEXCEPT;

/* What fanbeam_render is to leave, and where. NULL is a picture that is not wanted; what nobody wants
 * is not computed, but for the powers of the B-scope, which every frame is made with. Counts are of
 * elements: at least rows x columns, what is beyond stays. */
typedef struct fanbeam_output {
  uint32_t size;
  uint32_t layers; /* 0, FANBEAM_BSCOPE, or FANBEAM_BSCOPE | FANBEAM_CSCOPE: ground truth */
  uint8_t* bscope; /* 8-bit grey */
  size_t bscope_count;
  uint8_t* cscope;
  size_t cscope_count;
  double* bscope_W; /* expected power of the echoes; of a sample, with its noise */
  size_t bscope_W_count;
  double* cscope_W_m3; /* the same times R^3, summed over range */
  size_t cscope_W_m3_count;
  /* Left by a rendering that succeeds: */
  double noise_W;  /* mean noise that the receiver adds to each cell of bscope_W; of a sample 0 */
  uint32_t events; /* FANBEAM_OUTSIDE_VOLUME and so on */
  uint32_t reserved;
  fanbeam_layers* truth; /* to be freed by fanbeam_free_layers; NULL without `layers` */
} fanbeam_output;

/* A frame, at once, by this thread and oneTBB's. `frame_index` keys what is random. */
FANBEAM_API fanbeam_status fanbeam_render(fanbeam_session* session, const fanbeam_pose* pose,
                                          uint64_t frame_index,
                                          fanbeam_output* output) FANBEAM_NOEXCEPT;

/* Ground truth by cell, row 0 as of watts. `scope` is FANBEAM_BSCOPE or FANBEAM_CSCOPE, as asked for;
 * `count` at least rows x columns.
 *   values  "visibility" (1 lit to 0 in shadow), "range_m" (C-scope), "grazing_rad", "nrcs" (linear),
 *           "elevation_rad" (B-scope), "double_bounce" (share of the power); 0 where nothing is seen
 *   ids     "material", FANBEAM_NO_MATERIAL where nothing is seen and of targets; "object", 0 the
 *           terrain
 * docs/products.md tells how they are made. Layers outlive their session; copy from them in any
 * number of threads. */
#define FANBEAM_NO_MATERIAL 0xFFFFu
FANBEAM_API fanbeam_status fanbeam_layer_values(const fanbeam_layers* layers, uint32_t scope,
                                                const char* name, float* values,
                                                size_t count) FANBEAM_NOEXCEPT;
FANBEAM_API fanbeam_status fanbeam_layer_ids(const fanbeam_layers* layers, uint32_t scope,
                                             const char* name, uint32_t* ids,
                                             size_t count) FANBEAM_NOEXCEPT;
/* What an id of "material" or "object" is called, until the layers are freed; NULL: there is none. */
FANBEAM_API const char* fanbeam_layer_id_name(const fanbeam_layers* layers, const char* name,
                                              uint32_t id) FANBEAM_NOEXCEPT;
/* NULL is nothing to free. */
FANBEAM_API void fanbeam_free_layers(fanbeam_layers* layers) FANBEAM_NOEXCEPT;

/* Hands a pose to the session's thread and returns: takes no lock of the library's, waits for no
 * frame, allocates some hundred bytes. The thread renders both pictures (with bscope_alone that one)
 * of the newest pose; one that a newer one overtakes before its turn is dropped. The first call
 * starts the thread, and calls beside it wait until it has. A pose out of range is refused here. */
FANBEAM_API fanbeam_status fanbeam_submit_pose(fanbeam_session* session,
                                               const fanbeam_pose* pose) FANBEAM_NOEXCEPT;

typedef struct fanbeam_frame {
  uint32_t size;
  uint32_t events; /* FANBEAM_OUTSIDE_VOLUME and so on */
  uint64_t number; /* before the call: that of the frame you have, 0 for none; after: of this one.
                      From 1 up; also the frame_index that it was rendered with */
  double time_s;   /* the pose it was submitted with */
  double latitude_rad, longitude_rad, height_m;
  double roll_rad, pitch_rad, heading_rad;
  double pose_age_s; /* from fanbeam_submit_pose to the beginning of the frame */
  double render_s;   /* that the frame took */
  double age_s;      /* from its end to this call */
} fanbeam_frame;

/* Copies the newest frame of the session's thread. Takes no lock and waits for nobody, allocates
 * nothing but the words of a refusal, and what it copies is whole; `frame` and buffers stay untouched
 * unless it returns FANBEAM_OK. NULL is a picture that is not wanted; counts as above.
 * FANBEAM_NOTHING_NEW: the newest frame has the number frame->number, or there is none yet. A pose
 * that could not be rendered counts as a frame without pictures: its refusal is returned, once, and
 * frame->number alone moves on. */
FANBEAM_API fanbeam_status fanbeam_latest_frame(fanbeam_session* session, fanbeam_frame* frame,
                                                uint8_t* bscope, size_t bscope_count,
                                                uint8_t* cscope,
                                                size_t cscope_count) FANBEAM_NOEXCEPT;

#ifdef __cplusplus
}
#endif

#endif
