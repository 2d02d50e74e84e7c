/* Opens a scene, renders a frame of its flight, lets it rain, and has a thread of the library render
 * the poses that follow; the newest B-scope becomes bscope.pgm.
 *
 *   example SHIPPED SCENE      share/fanbeam below the prefix, and a scene folder with a flight
 *
 *   cc -std=c99 example.c $(pkg-config --cflags --libs fanbeam) -o example */
#define _POSIX_C_SOURCE 199309L /* nanosleep */
#include <fanbeam/fanbeam.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/* Prints what the last call had to say; 1 when it failed. */
static int failed(const char* what, fanbeam_status status) {
  if (*fanbeam_last_warnings() != '\0') fprintf(stderr, "%s\n", fanbeam_last_warnings());
  if (status >= 0) return 0;
  fprintf(stderr, "%s: %s\n", what, fanbeam_last_error());
  return 1;
}

/* A simulator would look once in each frame of its own. */
static int wait_for(fanbeam_session* session, double height_m, uint8_t* bscope, size_t pixels) {
  const struct timespec nap = {0, 1000000};
  fanbeam_frame frame = {.size = sizeof frame};
  while (frame.height_m != height_m) {
    if (failed("latest", fanbeam_latest_frame(session, &frame, bscope, pixels, NULL, 0))) return 1;
    nanosleep(&nap, NULL);
  }
  printf("frame %lu in %.1f ms\n", (unsigned long)frame.number, 1e3 * frame.render_s);
  return 0;
}

static int fly(fanbeam_session* session, fanbeam_pose pose, uint8_t* bscope, size_t pixels) {
  const fanbeam_weather rain = {
      .size = sizeof rain, .given = FANBEAM_RAIN_RATE, .rain_rate_mm_per_h = 10.0};
  fanbeam_output output = {.size = sizeof output, .bscope = bscope, .bscope_count = pixels};
  int i;
  if (failed("render", fanbeam_render(session, &pose, 0, &output))) return 1; /* at once */
  if (failed("weather", fanbeam_set_weather(session, &rain))) return 1;
  for (i = 0; i < 5; ++i) { /* without waiting: the newest wins */
    pose.height_m += 1.0;
    if (failed("submit", fanbeam_submit_pose(session, &pose))) return 1;
  }
  return wait_for(session, pose.height_m, bscope, pixels);
}

static int write_pgm(const char* name, const fanbeam_facts* facts, const uint8_t* bscope) {
  FILE* const file = fopen(name, "wb");
  if (file == NULL) return 1;
  fprintf(file, "P5\n%u %u\n255\n", (unsigned)facts->columns, (unsigned)facts->bscope_rows);
  fwrite(bscope, facts->columns, facts->bscope_rows, file);
  return fclose(file) != 0;
}

static int run(fanbeam_session* session) {
  fanbeam_facts facts = {.size = sizeof facts};
  fanbeam_pose pose = {.size = sizeof pose};
  uint8_t* bscope;
  size_t pixels;
  int bad;
  if (failed("facts", fanbeam_get_facts(session, &facts))) return 1;
  if (failed("first pose", fanbeam_flown_pose(session, 0, &pose))) return 1;
  pixels = (size_t)facts.columns * facts.bscope_rows;
  bscope = malloc(pixels);
  bad = bscope == NULL || fly(session, pose, bscope, pixels) ||
        write_pgm("bscope.pgm", &facts, bscope);
  free(bscope);
  return bad;
}

int main(int argc, char** argv) {
  fanbeam_setup setup = {.size = sizeof setup};
  fanbeam_session* session = NULL;
  int bad;
  if (argc != 3) {
    fprintf(stderr, "usage: example SHIPPED SCENE\n");
    return 2;
  }
  setup.shipped_folder = argv[1];
  if (failed(argv[2], fanbeam_open(argv[2], &setup, &session))) return 3;
  bad = run(session);
  fanbeam_close(session);
  return bad;
}
