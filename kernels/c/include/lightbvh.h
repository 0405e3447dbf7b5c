/*
 * lightbvh for C and C++: samples one of many moving lights with its exact probability, on the CPU and on devices.
 *
 * Lengths are metres, angles radians, radiance W/(m^2 sr), intensity W/sr, all emission linear RGB; or lumens in place
 * of watts throughout. A function that may fail returns a lightbvh_status; lightbvh_last_error() then says in words
 * what was wrong and what to do. A function that fails has changed nothing and written nothing, except where it says
 * so. No function lets a Rust panic out, or ends the program, unless memory runs out.
 *
 * One handle may be read by several threads at once (functions that take it as const), or changed by one.
 */
#ifndef LIGHTBVH_H
#define LIGHTBVH_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What a function did. */
typedef enum lightbvh_status {
    LIGHTBVH_OK = 0,
    LIGHTBVH_BAD_POINTER = 1,      /* a pointer is null or not aligned, or a length is beyond all memory */
    LIGHTBVH_BAD_TAG = 2,          /* a model, a kind of light or edit, a kernel, a buffer or a device bit is unknown */
    LIGHTBVH_BAD_POINT = 3,        /* a point is not within 2^40 m, its normal neither zero nor of length 1 (its square
                                      within 2^-7), or u, v are not in [0, 1) */
    LIGHTBVH_NO_LIGHT = 4,         /* there is no light of that number or part in that instance */
    LIGHTBVH_PANICKED = 5,         /* a defect of this library; what was being changed can only be freed */
    LIGHTBVH_NO_REBUILD = 6,       /* a background build failed; the light BVH keeps its trees, another build follows */
    LIGHTBVH_WRONG_MODEL = 7,      /* the mirror is of another model, or the model does not hold that kind of light */
    LIGHTBVH_UNKNOWN_MESH = 8,     /* no mesh has that id: it was removed, or is of another light BVH */
    LIGHTBVH_UNKNOWN_INSTANCE = 9, /* no instance has that id, as above */
    LIGHTBVH_NOT_A_LIGHT = 10,     /* the instance is of a mesh, no light by itself; Rust's EditReason::NoLight */
    LIGHTBVH_EMPTY_MESH = 11,
    LIGHTBVH_BAD_LIGHT = 12,       /* a number of a light is outside its range */
    LIGHTBVH_BAD_TRANSFORM = 13,   /* an entry, or a place where it moves a light, is beyond 2^40 */
    LIGHTBVH_BAD_RADIANCE = 14,    /* a factor is neither 0 nor from 2^-60 to 2^60 */
    LIGHTBVH_BAD_RANGE = 15,       /* lights to be set are not all in the mesh */
    LIGHTBVH_IN_USE = 16,          /* a mesh to be removed has instances */
    LIGHTBVH_TOO_MANY = 17,        /* more than 2^30 lights or elements, 2^27 instances, or 2^32 invocations */
    LIGHTBVH_BAD_WORDS = 18,       /* words are no light BVH of that model */
    LIGHTBVH_INEXACT = 19,         /* a device does not calculate as the CPU does */
    LIGHTBVH_REFUSED = 20          /* an edit is refused for another reason */
} lightbvh_status;

/* What the last function that failed on this thread had to say, in UTF-8; "" before any did. It stays until the next
 * one fails on this thread. Never null. */
const char *lightbvh_last_error(void);

/* ---- Light BVHs ---- */

/* A light BVH: lights by themselves, meshes of lights with their instances, and the trees over them. It starts a thread
 * only if lightbvh_end_frame is called. */
typedef struct lightbvh lightbvh;

/* What a light BVH holds. Each has kernels of its own. */
typedef enum lightbvh_model {
    LIGHTBVH_TRIANGLES = 0,    /* triangles alone, 24 bytes a child of a node */
    LIGHTBVH_ANY_LIGHTS = 1,   /* lights of every kind; nodes know cones and ranges, 32 bytes */
    LIGHTBVH_MASKED_LIGHTS = 2 /* the same with masks, 36 bytes */
} lightbvh_model;

/* One without lights, to be freed by lightbvh_free; null for an unknown model, and if memory or the library fails. */
lightbvh *lightbvh_create(uint32_t model);
/* The one that lightbvh_words wrote, in this program or another; null, with lightbvh_last_error, if the words are
 * none of that model. Indices and numbers of lights stay; ids are new: lightbvh_mesh_at, lightbvh_instance_at. */
lightbvh *lightbvh_create_from_words(uint32_t model, const uint32_t *words, size_t count);
/* Its words (docs/format.md): `count` of them, of which the first `capacity` are written. Takes the time of a copy
 * of all arrays, so give enough capacity at once in a loop. */
lightbvh_status lightbvh_words(const lightbvh *bvh, uint32_t *words, size_t capacity, size_t *count);
/* Frees it, once a build under way has ended: 0.4 s for a mesh of 10^6 triangles. Null does nothing. */
void lightbvh_free(lightbvh *bvh);

/* ---- Lights ---- */

typedef enum lightbvh_kind {
    LIGHTBVH_TRIANGLE = 0,  /* p, a, b: its vertices, counter-clockwise seen from its front */
    LIGHTBVH_POINT = 1,     /* p; range */
    LIGHTBVH_SPOT = 2,      /* p; a: its axis, of length 1; inner, outer; range */
    LIGHTBVH_SPHERE = 3,    /* p: its centre; radius */
    LIGHTBVH_RECTANGLE = 4, /* p: its centre; a, b: to the middles of two sides, a x b points to its front */
    LIGHTBVH_DISC = 5       /* p: its centre; a, b: half axes, as of a rectangle */
} lightbvh_kind;

/* lightbvh_light.flags, of triangles, rectangles and discs: both sides emit. */
#define LIGHTBVH_TWO_SIDED 1u

/* A light in its mesh's space, or by itself in the world. Fields that its kind does not name are ignored. */
typedef struct lightbvh_light {
    uint32_t kind;         /* lightbvh_kind */
    uint32_t flags;        /* 0 or LIGHTBVH_TWO_SIDED */
    float p[3], a[3], b[3]; /* coordinates within 2^40 m */
    float emission[3];     /* radiance; of points and spots intensity. Each 0, or from 2^-100 to 2^100 */
    float radius;          /* m, 2^-60 to 2^40 */
    float range;           /* m, 2^-20 to 2^40: times 1 - (d / range)^4 at distance d, nothing beyond; 0 for none */
    float inner, outer;    /* half angles of a spot, 0 <= inner <= outer <= pi: all of it up to inner, nothing from
                              outer on, at t between times ((cos t - cos outer) / (cos inner - cos outer))^2 */
} lightbvh_light;

/* An affine map from the mesh's space to the world: x -> A x + t. Entries within 2^40. */
typedef struct lightbvh_transform {
    float columns[3][3];  /* the columns of A */
    float translation[3]; /* t, m */
} lightbvh_transform;

/* A mesh, or an instance: of a mesh, or a light by itself. All zero is none. An id never means another one. */
typedef struct lightbvh_id {
    uint32_t tree, index, generation, kind;
} lightbvh_id;

/* ---- Edits. Samples see them after the next lightbvh_refit ---- */

/* A mesh of `count` lights, at least one, in its own space. It is not in the world yet. */
lightbvh_status lightbvh_add_mesh(lightbvh *bvh, const lightbvh_light *lights, size_t count, lightbvh_id *mesh);
/* Puts a mesh into the world, with the factor 1 on its radiance and all masks. */
lightbvh_status lightbvh_add_instance(lightbvh *bvh, lightbvh_id mesh, lightbvh_transform transform,
                                      lightbvh_id *instance);
/* Puts a light by itself into the world: an instance, with a transform, a factor on radiance and a mask. */
lightbvh_status lightbvh_add_light(lightbvh *bvh, const lightbvh_light *light, lightbvh_id *instance);
/* Makes a light by itself another one, of any kind and in any place. */
lightbvh_status lightbvh_set_light(lightbvh *bvh, lightbvh_id instance, const lightbvh_light *light);
lightbvh_status lightbvh_set_transform(lightbvh *bvh, lightbvh_id instance, lightbvh_transform transform);
/* A factor on the radiance of an instance, linear RGB: each 0, or from 2^-60 to 2^60. Zeros turn it off. */
lightbvh_status lightbvh_set_radiance(lightbvh *bvh, lightbvh_id instance, float red, float green, float blue);
/* The instance lights the points whose mask has a bit of this one. Only LIGHTBVH_MASKED_LIGHTS looks at masks. */
lightbvh_status lightbvh_set_mask(lightbvh *bvh, lightbvh_id instance, uint32_t mask);
/* `count` lights of a mesh from index `first` on become others, in all its instances. */
lightbvh_status lightbvh_set_lights(lightbvh *bvh, lightbvh_id mesh, uint32_t first, const lightbvh_light *lights,
                                    size_t count);
/* Removes an instance, or a mesh that has none. */
lightbvh_status lightbvh_remove(lightbvh *bvh, lightbvh_id id);

typedef enum lightbvh_edit_kind {       /* fields that are read */
    LIGHTBVH_ADD_MESH = 1,      /* lights, count */
    LIGHTBVH_ADD_INSTANCE = 2,  /* id: the mesh; transform, radiance, mask */
    LIGHTBVH_ADD_LIGHT = 3,     /* lights: one; mask */
    LIGHTBVH_SET_LIGHT = 4,     /* id; lights: one */
    LIGHTBVH_SET_TRANSFORM = 5, /* id; transform */
    LIGHTBVH_SET_RADIANCE = 6,  /* id; radiance */
    LIGHTBVH_SET_MASK = 7,      /* id; mask */
    LIGHTBVH_SET_LIGHTS = 8,    /* id: the mesh; first, lights, count */
    LIGHTBVH_REMOVE = 9         /* id */
} lightbvh_edit_kind;

/* lightbvh_edit.mask, lightbvh_point.mask: every bit. 0 lights nothing. */
#define LIGHTBVH_ALL_MASKS UINT32_MAX

/* One of several edits, to be made by lightbvh_edit_of: in cleared memory the factor on radiance and the mask are 0, so
 * nothing shines. Ids that others of the same batch make are not known to it. */
typedef struct lightbvh_edit {
    uint32_t kind; /* lightbvh_edit_kind */
    uint32_t first;
    lightbvh_id id;
    const lightbvh_light *lights;
    size_t count;
    lightbvh_transform transform;
    float radiance[3];
    uint32_t mask;
} lightbvh_edit;

/* An edit of a kind: the identity, factors of 1, all masks; no id and no lights. */
static inline lightbvh_edit lightbvh_edit_of(uint32_t kind)
{
    lightbvh_edit edit = {kind, 0, {0, 0, 0, 0}, NULL, 0, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}}, {1, 1, 1},
                          LIGHTBVH_ALL_MASKS};
    return edit;
}

/* Applies `count` edits in their order, all or none; many together take less time than one at a time. `ids` is null
 * or has a place for each: the id that it made, or zeros. If an edit is refused, its index is written to `failed`,
 * unless null. */
lightbvh_status lightbvh_apply(lightbvh *bvh, const lightbvh_edit *edits, size_t count, lightbvh_id *ids,
                               size_t *failed);
/* Applies each of `count` edits that is sound, in order, and returns the status of the first one that is not.
 * `statuses` is null or has a place for each. */
lightbvh_status lightbvh_apply_each(lightbvh *bvh, const lightbvh_edit *edits, size_t count, lightbvh_id *ids,
                                    lightbvh_status *statuses);

/* Computes the nodes that the edits touched: once a frame. */
lightbvh_status lightbvh_refit(lightbvh *bvh);
/* Refits, then builds all trees again that changed, within the call. */
lightbvh_status lightbvh_rebuild(lightbvh *bvh);

/* ---- Builds in the background, on one thread for each light BVH. A frame: lightbvh_begin_frame, edits,
 * lightbvh_refit, lightbvh_mirror_frame and its steps if there is a device, lightbvh_end_frame ---- */

/* What the start of a frame did. */
typedef struct lightbvh_frame_start {
    uint32_t swapped; /* 1 if a new tree over the instances was swapped in */
    uint32_t meshes;  /* number of meshes that got new trees */
} lightbvh_frame_start;

/* Swaps in finished trees. Call it before the frame's lightbvh_refit. `start` may be null. */
lightbvh_status lightbvh_begin_frame(lightbvh *bvh, lightbvh_frame_start *start);
/* Starts the next build. Call it after the frame's lightbvh_refit. */
lightbvh_status lightbvh_end_frame(lightbvh *bvh);
/* Call it once, before the first frame. If `frames` is 0, the default, trees are swapped in once they are ready, and no
 * frame waits. Otherwise they are swapped in after that many frames, and that frame waits for them if needed: samples
 * then depend on the edits alone, never on the thread's speed. A build under way is waited for and dropped. */
lightbvh_status lightbvh_swap_after(lightbvh *bvh, uint32_t frames);

/* ---- Samples ---- */

/* A point to be lit. The normal is of length 1, or zero for a point in a volume. */
typedef struct lightbvh_point {
    float p[3];
    float n[3];
    uint32_t mask; /* only LIGHTBVH_MASKED_LIGHTS looks at it: 0 is lit by nothing */
} lightbvh_point;

/* A point on a light. Seen at distance d under the cosine c of its normal, a light chosen with probability pmf has the
 * density pmf * density * d * d / c over solid angle. */
typedef struct lightbvh_light_point {
    float p[3];
    float density;     /* 1 / area, 1/m^2, the same for all points of the light; of a sphere the area that the receiver
                          sees, 2 pi r^2 (1 - r / distance of its centre). 0 without area and within a sphere; 1 of
                          points and spots */
    float normal[3];   /* of the front side, of length 1; zero of points and spots */
    uint32_t flags;    /* LIGHTBVH_TWO_SIDED, or 2 of points and spots: `radiance` is intensity then, W/sr */
    float radiance[3]; /* W/(m^2 sr), with the instance's factor; of points and spots with cone and range, too */
} lightbvh_light_point;

/* A light, a point on it, and what it sends. The estimate is irradiance / pmf, if a shadow ray is free. */
typedef struct lightbvh_sampled {
    lightbvh_id instance;
    uint32_t part;        /* index of the light in its mesh; 0 of a light by itself */
    float pmf;            /* probability of the light, in (0, 1]; 0 where no light sends anything: all is zero then */
    lightbvh_light_point point;
    float direction[3];   /* from the receiver, of length 1 */
    float distance;       /* m */
    float pdf;            /* density over solid angle, pmf included, 1/sr: see lightbvh_mis_weight; 0 of points and
                             spots */
    float irradiance[3];  /* at the receiver's front, visibility apart, W/m^2 */
} lightbvh_sampled;

/* Chooses a light for a point by a uniform number of 64 bits, and a point on it by two numbers in [0, 1). */
lightbvh_status lightbvh_sample_light(const lightbvh *bvh, const lightbvh_point *point, uint64_t random, float u,
                                      float v, lightbvh_sampled *sampled);
/* Density over solid angle, 1/sr, with which lightbvh_sample_light finds `position` on a light, where a ray from the
 * point has met it: for multiple importance sampling. 0 where the light does not emit to there, and of points and
 * spots. `position` is not checked to lie on the light. */
lightbvh_status lightbvh_pdf_of_hit(const lightbvh *bvh, const lightbvh_point *point, lightbvh_id instance,
                                    uint32_t part, const float position[3], float *pdf);
/* Weight of a direction that was chosen with the density `own`, 1/sr, and that another technique chooses with `other`:
 * own^2 / (own^2 + other^2), the power heuristic. Densities are 0 or normal numbers. If the surface scatters with the
 * density s, a light sample has the weight lightbvh_mis_weight(sampled.pdf, s). A ray that met a light has
 * 1 - lightbvh_mis_weight(pdf, s), with the pdf of lightbvh_pdf_of_hit. The weight is 1 where `own` is 0: no ray hits
 * points and spots. */
float lightbvh_mis_weight(float own, float other);

/* lightbvh_sample.light and .instance where there is no light with flux. */
#define LIGHTBVH_INVALID UINT32_MAX

/* A light by its number, and the probability with which it was chosen: what kernels write. */
typedef struct lightbvh_sampled_light {
    uint32_t light;
    uint32_t instance; /* index of the instance: lightbvh_id.index, lightbvh_owner */
    float pmf;         /* in (0, 1]; 0 with LIGHTBVH_INVALID */
} lightbvh_sampled_light;

/* Chooses a light for a point by a uniform number of 64 bits. */
lightbvh_status lightbvh_sample(const lightbvh *bvh, const lightbvh_point *point, uint64_t random,
                                lightbvh_sampled_light *sample);
/* As lightbvh_sample for `count` points with a number each; faster than one at a time. */
lightbvh_status lightbvh_sample_batch(const lightbvh *bvh, const lightbvh_point *points, const uint64_t *randoms,
                                      size_t count, lightbvh_sampled_light *samples);
/* The probability of a light at a point: to the bit the one that comes with its sample; 0 where there is no such
 * light. */
lightbvh_status lightbvh_pmf(const lightbvh *bvh, const lightbvh_point *point, uint32_t light, uint32_t instance,
                             float *pmf);
/* The same by the id of an instance and the index of a light in its mesh. */
lightbvh_status lightbvh_pmf_of(const lightbvh *bvh, const lightbvh_point *point, lightbvh_id instance, uint32_t part,
                                float *pmf);
/* Whose light a sample names: the id of its instance, and its index in its mesh. */
lightbvh_status lightbvh_owner(const lightbvh *bvh, uint32_t light, uint32_t instance, lightbvh_id *id, uint32_t *part);
/* A point on the light that a sample names, for a receiver, by two numbers in [0, 1). */
lightbvh_status lightbvh_point_of(const lightbvh *bvh, const lightbvh_point *point, uint32_t light, uint32_t instance,
                                  float u, float v, lightbvh_light_point *on);

/* ---- Ids, and numbers of lights ---- */

/* The id of the mesh, or of the instance, of that index. */
lightbvh_status lightbvh_mesh_at(const lightbvh *bvh, uint32_t index, lightbvh_id *mesh);
lightbvh_status lightbvh_instance_at(const lightbvh *bvh, uint32_t index, lightbvh_id *instance);
/* The numbers of an instance's lights: `count` from `first`, in the order of its mesh. */
lightbvh_status lightbvh_lights_of(const lightbvh *bvh, lightbvh_id instance, uint32_t *first, uint32_t *count);

/* Numbers of lights: `count` from `first` on. */
typedef struct lightbvh_range {
    uint32_t first, count;
} lightbvh_range;

/* If you keep light numbers (reservoirs): each frame, after the edits, read the removed ones, replace what you keep,
 * then forget them. Until then no new light gets such a number. If more than 65536 of them wait, and more than there
 * are lights (or than half of what is left of 2^30, if that is less), all are free: the first range then covers every
 * number there was, so drop all that is kept by number. */

/* Ranges of numbers of removed lights, since they were forgotten last: `count` of them, of which the first
 * `capacity` are written. */
lightbvh_status lightbvh_removed_lights(const lightbvh *bvh, lightbvh_range *ranges, size_t capacity, size_t *count);
/* New lights may get those numbers from now on. */
lightbvh_status lightbvh_forget_removed_lights(lightbvh *bvh);

/* ---- Devices: Vulkan 1.2 with vulkanMemoryModel, or another API that takes SPIR-V (kernels/gpu/README.md) ---- */

/* Storage buffers. The steps of lightbvh_mirror_frame fill the first six. The engine fills QUERIES, SAMPLES, NUMBERS
 * and OPERANDS, and reads RESULTS and ANSWERS, which kernels write. */
typedef enum lightbvh_buffer {
    LIGHTBVH_NODES = 0,
    LIGHTBVH_LIGHTS = 1,
    LIGHTBVH_INSTANCES = 2,
    LIGHTBVH_TRAILS = 3,
    LIGHTBVH_LIST = 4,     /* uploaded whole in each frame. Frames under way at once need one each */
    LIGHTBVH_CHILDREN = 5, /* written and read by the refit's kernels alone. Frames under way at once need one each */
    LIGHTBVH_QUERIES = 6,  /* lightbvh_query; lightbvh_masked_query of LIGHTBVH_MASKED_LIGHTS */
    LIGHTBVH_RESULTS = 7,  /* of _SAMPLE lightbvh_sampled_light, of _PMF float, of _LIGHT_POINTS lightbvh_light_point */
    LIGHTBVH_SAMPLES = 8,  /* lightbvh_sampled_light: the buffer that _SAMPLE wrote as its RESULTS */
    LIGHTBVH_NUMBERS = 9,  /* float[2], in [0, 1) */
    LIGHTBVH_OPERANDS = 10,
    LIGHTBVH_ANSWERS = 11
} lightbvh_buffer;

/* Points on sampled lights: after _SAMPLE dispatch _LIGHT_POINTS with the same QUERIES, the RESULTS of _SAMPLE bound as
 * SAMPLES, and another buffer as RESULTS. Sample k is that of query k, and takes numbers k.
 *
 * Density over solid angle of a hit, as of lightbvh_pdf_of_hit: _PMF with the hit's light and instance in query k gives
 * pmf. _LIGHT_POINTS with that light and instance in sample k, and any numbers, gives density. The result is
 * pmf * density * d * d / c, for the distance d of the hit and the cosine c of the light's normal there, without its
 * sign if the light is LIGHTBVH_TWO_SIDED. If c is not above 0, the result is 0. */
typedef enum lightbvh_kernel_id {
    LIGHTBVH_REFIT_BOTTOM = 0,
    LIGHTBVH_REFIT_TOP = 1,
    LIGHTBVH_REFIT_NODES = 2,
    LIGHTBVH_SAMPLE = 3,       /* a sample for each query; push constants: lightbvh_frame.push */
    LIGHTBVH_PMF = 4,          /* the probability of each query's light; the same push constants */
    LIGHTBVH_LIGHT_POINTS = 5, /* a point on each sample's light, for its query; push constant: their number */
    LIGHTBVH_SELF_TEST = 6     /* 128 invocations; push constant: 128 */
} lightbvh_kernel_id;

/* What LIGHTBVH_SAMPLE and LIGHTBVH_PMF are asked: the random number, its high word first; the light and its
 * instance. */
typedef struct lightbvh_query {
    float p[3];
    float n[3];
    uint32_t words[2];
} lightbvh_query;

typedef struct lightbvh_masked_query {
    lightbvh_point point;
    uint32_t words[2];
} lightbvh_masked_query;

/* A storage buffer that a kernel takes. */
typedef struct lightbvh_binding {
    uint32_t buffer; /* lightbvh_buffer */
    uint32_t writes; /* 1 if the kernel writes it */
    uint32_t stride; /* bytes of an element; give at least one */
} lightbvh_binding;

/* A kernel: a SPIR-V 1.5 module with one entry point, 64 invocations wide. */
typedef struct lightbvh_kernel {
    char name[32];               /* of the entry point */
    uint32_t push_bytes;
    uint32_t binding_count;
    lightbvh_binding bindings[6]; /* binding k of descriptor set 0 */
} lightbvh_kernel;

/* What a device has, for its modules. */
typedef enum lightbvh_device {
    LIGHTBVH_PRESERVES_ZERO_INF_NAN = 1, /* shaderSignedZeroInfNanPreserveFloat32 */
    LIGHTBVH_ROUNDS_TO_EVEN = 2,         /* shaderRoundingModeRTEFloat32 */
    LIGHTBVH_NO_MEMORY_MODEL = 4         /* vulkanMemoryModel is not enabled */
} lightbvh_device;

/* What a kernel (lightbvh_kernel_id) of a model takes. */
lightbvh_status lightbvh_kernel_of(uint32_t model, uint32_t which, lightbvh_kernel *kernel);
/* Its module for a device with these bits of lightbvh_device: `count` words, of which the first `capacity` are
 * written. */
lightbvh_status lightbvh_kernel_words(uint32_t model, uint32_t which, uint32_t device, uint32_t *words, size_t capacity,
                                      size_t *count);
/* Workgroups to dispatch in x, y and z for `count` invocations. */
lightbvh_status lightbvh_groups(uint32_t count, uint32_t groups[3]);

/* Does a device calculate exactly? The words of LIGHTBVH_OPERANDS: `count` of them, of which the first `capacity` are
 * written. */
lightbvh_status lightbvh_self_test_operands(uint32_t *words, size_t capacity, size_t *count);
/* LIGHTBVH_INEXACT if what LIGHTBVH_SELF_TEST wrote to LIGHTBVH_ANSWERS differs from the CPU's answers. */
#define LIGHTBVH_ANSWERS_BYTES 19456
lightbvh_status lightbvh_self_test_check(const void *answers, size_t bytes);

/* Tracks what a device holds of a light BVH: one for each device. */
typedef struct lightbvh_mirror lightbvh_mirror;

typedef enum lightbvh_step_kind { LIGHTBVH_RESIZE = 0, LIGHTBVH_UPLOAD = 1, LIGHTBVH_DISPATCH = 2 } lightbvh_step_kind;

/* A step of a frame, to be done in order, with the barriers of kernels/gpu/README.md. */
typedef struct lightbvh_step {
    uint32_t kind;    /* lightbvh_step_kind */
    uint32_t which;   /* lightbvh_buffer to replace by one of at least `bytes` bytes, or to write; lightbvh_kernel_id */
    uint64_t at;      /* LIGHTBVH_UPLOAD: first byte to be written, a multiple of 4 */
    uint64_t bytes;   /* size of the buffer or of the data, not 0, a multiple of 4 */
    const void *data; /* LIGHTBVH_UPLOAD */
    uint32_t push[3]; /* LIGHTBVH_DISPATCH: push constants */
    uint32_t count;   /* LIGHTBVH_DISPATCH: invocations, not 0 */
} lightbvh_step;

typedef struct lightbvh_frame {
    const lightbvh_step *steps; /* until the light BVH or the mirror is changed or freed */
    size_t count;               /* 0 if nothing changed */
    uint32_t push[10];          /* push constants of LIGHTBVH_SAMPLE and _PMF; set push[0] to the number of queries */
} lightbvh_frame;

/* A mirror, to be freed by lightbvh_mirror_free; null as lightbvh_create. */
lightbvh_mirror *lightbvh_mirror_create(uint32_t model);
void lightbvh_mirror_free(lightbvh_mirror *mirror);
/* The steps that bring the device's buffers to the light BVH. Call it after the frame's edits and lightbvh_refit. If
 * the device failed to do them, begin with a new mirror. A mirror may skip frames.
 *
 * With two frames under way, keep a buffer that was replaced until the submissions that use it have ended. A
 * LIGHTBVH_RESIZE of LIST or CHILDREN is for both copies: replace the other one before its next frame. */
lightbvh_status lightbvh_mirror_frame(lightbvh_mirror *mirror, const lightbvh *bvh, lightbvh_frame *frame);
/* Compares a buffer (lightbvh_buffer), as the device has it after a frame, with the CPU's words in use; other words
 * mean nothing. Writes how many were compared and how many differ. LIST and the buffers after it have no such words:
 * none is compared. */
lightbvh_status lightbvh_mirror_compare(const lightbvh_mirror *mirror, const lightbvh *bvh, uint32_t buffer,
                                        const void *held, size_t bytes, uint64_t *compared, uint64_t *different);

#ifdef __cplusplus
}
#endif

#endif
