//! Stable finding codes and their manual pages.
//!
//! A code is never reused. Ranges: `KC00` files and running, `KC01` job file, `KC02` reading NC text,
//! `KC03` writing NC text, `KC04` planning holes, `KC05` what a simulated program does wrong, `KC06` meshes,
//! `KC07` tools and machines, `KC08` geometry, `KC09` drilling, `KC10` face milling, `KC11` machines from codes,
//! `KC12` swept volumes.

use std::fmt;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The stable code of a finding, for example `KC0401`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Code(&'static str);

/// The manual page of a code: what it means, why it hurts, an example, the help.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ManualPage {
    /// The code.
    pub code: Code,
    /// Markdown text.
    pub text: &'static str,
    /// One line.
    pub title: &'static str,
}

macro_rules! codes {
    ($($name:ident = $code:literal, $title:literal, $text:literal;)*) => {
        impl Code {
            $(#[doc = concat!("`", $code, "`: ", $title, ".")] pub const $name: Code = Code($code);)*
        }
        const PAGES: &[ManualPage] = &[$(ManualPage { code: Code::$name, title: $title, text: $text },)*];
    };
}

codes! {
    FILE_NOT_READ = "KC0001", "a file cannot be read",
        "The file is not there, is too large for its kind, may not be read, or is no regular file: pipes and devices are not read. Text files are read up to 16 MB, drawings up to 64 MB, programs up to 256 MB, meshes up to 1 GiB. Paths in a job are relative to the folder of the job file.";
    NOT_TEXT = "KC0002", "a file is not UTF-8 text",
        "Job files and NC programs are read as UTF-8. Save the file again as UTF-8 (plain ASCII is UTF-8 too).";
    OUTPUT_NOT_WRITTEN = "KC0003", "an output file cannot be written",
        "The output folder cannot be made or written. Outputs are written whole (temporary file, then rename): what was there before is still there.";
    INPUT_IN_THE_WAY = "KC0004", "an output would replace a file that was read",
        "A file that was read (the job, a mesh, a drawing, a program, a machine) has the place and name of an output. A run never replaces what it read. Choose another folder with --out, or another name; nothing was written.";
    OUTPUT_BUSY = "KC0005", "another run is writing into the folder",
        "Two runs into one folder take turns, so that its files are all of one run. This run has waited for a minute and has written nothing. Run it again when the other one has ended, or choose another folder with --out.";
    CANCELLED = "KC0009", "the work was cancelled",
        "The caller asked the running work to stop. Nothing was written.";

    JOB_SYNTAX = "KC0101", "the job file is not valid TOML",
        "The text breaks the rules of TOML at the place shown: an unclosed string or bracket, a key given twice, a value without a key.";
    JOB_SHAPE = "KC0102", "the job file does not have the form of a job",
        "A key is unknown or missing, or a value has the wrong type. `kinecut schema job` prints the schema; an editor that reads it completes and checks keys as you type.";
    JOB_VALUE = "KC0103", "a value in the job file is out of range",
        "The value is not finite, has the wrong sign, or breaks the bound shown. Lengths are mm, feeds mm/min, angles degrees, speeds rev/min.";
    JOB_REFERENCE = "KC0104", "the job names something it does not define",
        "An operation names a tool number, a work offset or a file that the job does not have.";
    JOB_BUDGET = "KC0105", "the simulation would need more memory than allowed",
        "Memory grows with the inverse square of the grid step. The message gives the step that fits.";

    VERDICT_VOID = "KC0106", "a verdict is void",
        "A verdict is about bytes. The program, a tool, the machine, the stock, the design or the verdict itself was changed after it was given, so it proves nothing. Run the job again.";

    VERDICT_UNKNOWN = "KC0107", "it cannot be said whether a verdict holds",
        "A file that the verdict is about is not there, so nothing can be compared. Name the job file with --job, or run the command where the files are.";

    KEY_RENAMED = "KC0108", "a key of the job file has a new name",
        "The key is read as before. Write the name shown: it is the trade's word, and the one that the manual uses.";

    NC_WORD = "KC0201", "an NC word is not understood",
        "The control would do something with this word that kinecut does not know. Nothing that could move an axis is ever skipped, so the program is refused.";
    NC_SYNTAX = "KC0202", "an NC block is malformed",
        "A number or bracket is malformed, or a word stands twice in a block.";
    NC_ARC = "KC0203", "an arc or involute does not fit its end points",
        "The distances of start and end from the centre differ by more than the control allows, or the centre is missing. The control would stop with an alarm or cut another curve.";
    NC_STATE = "KC0204", "a block lacks something it needs",
        "A feed move without feed, a move before the position is known, a length offset without tool: the control would stop or guess.";

    COMPENSATION = "KC0205", "the control cannot compensate this contour",
        "Cutter compensation (G41, G42) begins and ends on a straight move that is longer than the radius (on LinuxCNC it may begin on an arc), turns inside corners only where there is room for the tool, and follows a hollow arc only when its radius is larger than the compensation. The control would stop with an alarm, or cut into the contour.";
    REGISTER = "KC0206", "a register is not that of the tool",
        "A tool runs with the length or radius of another register, or without its length. The control lifts the tool by what the register holds: a length that is too short drives the tool into the part. Where both lengths are known the simulation is done with the wrong one, as the machine would. In a translated program: which number a register has in the table of the other control.";

    NC_ASSUMED = "KC0207", "what a number means depends on a setting of the control",
        "A coordinate without a decimal point, a unit that the program does not say, a word with two readings: the control has a parameter for it. The message says what was assumed; write the program so that there is nothing to assume.";

    POST_CONTROL = "KC0301", "the control is unknown or cannot carry the program",
        "The post does not know this control, or the control has no word for a motion of the program.";
    POST_NUMBER = "KC0302", "a number does not fit the control's format",
        "A coordinate has more digits before the decimal point than the control reads, or a radius rounds to zero.";

    READ_BACK = "KC0303", "the posted text is not what was planned",
        "The program was read back as the control reads it, and a move was missing, changed or added. This is a defect of kinecut: do not run the program, report it with the job.";
    POST_TEMPLATE = "KC0304", "a template of the post does not work",
        "The template of the start or the end of a program has an error, names something that does not exist, gives text that kinecut does not understand, or leaves the control in a state in which the program would mean something else.";
    TRANSLATED = "KC0305", "a translated program lacks something",
        "A program was written for another control, and something of it has no counterpart there: a word that moves nothing, a message to the operator, the passage between moves, the way of rapid moves. The path is the same; look at what is named before the new text is run.";

    CUTTER_TOO_LARGE = "KC0401", "the cutter does not fit into the bore",
        "The path radius (bore diameter minus cutter diameter) / 2 minus the allowance must be positive.";
    START_OUTSIDE = "KC0402", "the start point is not inside the path circle",
        "An involute lead-in starts inside the circle on which the cutter centre runs at the wall. Choose a start nearer to the centre.";
    ENTRY_IMPOSSIBLE = "KC0403", "the cutter cannot enter the material this way",
        "A plunge needs a cutter that cuts at its centre; a helix needs a ramp the cutter can follow and a radius that leaves no core; a pre-drilled entry needs a hole into which the cutter fits.";
    PLAN_VALUE = "KC0404", "a planning value is out of range",
        "A step, allowance, depth, feed or number of turns is not usable. The message gives the bound.";
    SLUG = "KC0405", "a core comes loose",
        "A helix along the outline of a through bore leaves the core standing; when the cutter breaks through, the core is a loose slug that can jam the cutter or be thrown. Hold it from below, or clear the bore by another strategy.";
    NOTHING_TO_MILL = "KC0406", "the stock to leave fills the bore",
        "With the stock to leave on its wall the bore is not larger than the cutter: nothing is milled, and the operation is left out of the program.";
    LEAD_ROOM = "KC0407", "a lead finds no room",
        "A contour is joined and left on arcs that are tangent to it, beside the material that stays. Beside no place of the loop, or the one that is asked for, is there room for the smallest arc. Give another start, a smaller lead_radius, or take a smaller cutter.";
    TABS = "KC0408", "tabs do not fit",
        "Tabs lie on straight pieces or wide arcs of a contour, off its corners and off the place where it begins. Fewer fit than are wanted, or the ways on which the cutter comes up and down beside them overlap, so that they are one. The report shows where they are.";
    CORNERS_STAY = "KC0409", "inside corners stay",
        "A cutter leaves a fillet of its own radius in inside corners that are sharper. They are not cut, and not compared with the outline. Finish them with a smaller cutter, or draw them as they will be.";
    POCKET_LEFT = "KC0410", "stock is left that no pass reaches within the engagement",
        "Passes of a pocket stop where every way on would cut with a larger engagement than is allowed: between walls that are hardly wider apart than the cutter, and in corners. The lap along the wall cuts what is left there, at the engagement that comes. Allow a larger one, or take a smaller cutter.";
    POCKET_PARTS = "KC0411", "a pocket falls into parts for this cutter",
        "Between two parts of the pocket there is a neck that is narrower than the cutter. Each part is entered and cleared by itself; the neck stays, and is named among the corners that stay. A smaller cutter passes through it.";
    THREAD_TOOL = "KC0412", "a thread mill does not fit its thread",
        "A thread mill has the pitch and the flank angle of the thread, passes through its core hole with 0.2 mm to spare, and its neck, shank and holder clear the material at full depth. A tool nearly as wide as the hole runs on so steep a helix that it cuts its own flanks away. The message gives the part and the bound.";
    THREAD_CORE = "KC0413", "a core hole does not fit its milled thread",
        "A thread is milled into a hole that has its minor diameter: made by an operation before it, by `drilled`, or stated as `core`. A blind one is as deep as the thread, half a pitch of the lowest tooth, the way in or out and some free way together. In a smaller hole the roots of the teeth cut, a larger one than class 6H allows, or of other threads one that leaves less than three quarters of the height, leaves too little thread; in a shorter one the tool meets the floor.";
    THREAD_OVERCUT = "KC0414", "a thread mill overcuts the flanks",
        "The teeth are square to the axis while the groove runs at the lead angle, so that a tool that is large for its thread cuts more than its section. The radius of the path is corrected so that the pitch diameter is right; the flanks are still not quite straight, and the major diameter is smaller by twice the amount, which the message gives; a note where that is all. Take a smaller tool, or one whose profile its maker has corrected.";
    THREAD_FORM = "KC0415", "a posted thread is not the wanted one",
        "The helix was read back from the posted text, and its radius, pitch, hand, direction or height does not give the wanted thread: the pitch diameter by the envelope of the tool's flanks is off by more than the tolerance, a part of the groove is not cut, or a helix is missing. The message gives the numbers.";

    FULL_WIDTH = "KC0416", "levels of a slot are deep for a cutter that is wholly in the stock",
        "A slot as wide as the cutter is cut with half of its circle. Usual depths of a level there are half the diameter in steel and the diameter in aluminium; deeper, chips stay in the slot and the cutter breaks. Give a smaller stepdown, or take a smaller cutter, which goes in loops.";
    POCKET_REST = "KC0417", "an earlier cutter has left nothing to passes of this one",
        "A pocket with `rest` clears what a larger cutter before it has left: corners, and places into which that one does not go. Nothing is left, or so little that the lap along the wall takes it with less than 10 degrees of the cutter's circle. The lap is run all the same. Leave the operation out, or take a smaller cutter.";

    RAPID_IN_STOCK = "KC0501", "a rapid move goes through stock",
        "The cutter meets material in a rapid move. On most machines this breaks the cutter, and at times the spindle.";
    SHANK_IN_STOCK = "KC0502", "the shank meets stock",
        "The part of the tool above the cutting edges touches material. Use more flute length or a reduced neck.";
    HOLDER_IN_STOCK = "KC0503", "the holder meets stock",
        "The tool holder touches material. Use more stickout.";
    SPINDLE_OFF = "KC0504", "the cutter cuts with the spindle off",
        "Material is removed in a feed move while the spindle stands still.";
    WALL_GOUGED = "KC0505", "the wanted surface is gouged",
        "The cut part lies inside the wanted surface by more than the tolerance: the part is scrap.";
    STOCK_LEFT = "KC0506", "stock is left on the wanted surface",
        "The cut part lies outside the wanted surface by more than the tolerance.";
    TRAVEL_EXCEEDED = "KC0507", "an axis leaves its travel",
        "A position of the program lies beyond the travel limits of the machine axis.";
    DRILL_SIDEWAYS = "KC0508", "a drill cuts sideways",
        "A drill moves across its axis in material. It has no edge that could cut there; the simulated part is cut as if it had. A pointed tool of 100 degrees or less may chamfer an edge with its cone.";

    NOSE_IN_STOCK = "KC0509", "the nose of a tool meets stock",
        "The nose of a countersink, core drill or reamer does not cut: it must run in a hole that is there. Drill the hole first, or give the stock the hole it has.";

    NOTHING_REMOVED = "KC0511", "an operation or a program removes nothing",
        "The simulated tool took no material out of the stock. Mostly the zero, the work offset, the length of the tool or the stock is not as meant; a second pass over a finished face can be right. Look at where it runs before you run it.";
    BESIDE_STOCK = "KC0512", "an operation or a program lies beside the stock",
        "The place of the operation does not touch the stock at all, or more than half of the wall of a bore or pocket has no material around it. Where less of the wall looks out of a side it is not proven that this is meant. Correct its coordinates, or the stock.";
    BELOW_STOCK = "KC0513", "a tool goes into the table, or far below the stock",
        "A tool that leaves the underside of the stock by more than its point and the breakthrough meets table, parallels or vise. This is asked for within 50 mm of the stock. Correct the depth, raise `breakthrough` of the setup (3 mm if nothing is said), or state where the table is: `[setup] table = Z`, a height above the work zero; then no tool goes below that, and nothing else is assumed.";
    FEED_IN_AIR = "KC0514", "a tool feeds through air at depth",
        "The tool moves at feed, below the top of the stock, and neither cuts nor runs along a wall or floor: nearly all the way of an operation, in a whole drilling cycle, or for 20 diameters and 200 mm at a time. Mostly the place or the stock is not as meant.";
    PLUNGE = "KC0515", "a tool that does not cut at its centre goes down into material",
        "The middle of the tool does not cut: it would press on the material under it. Enter along a ramp or a helix, in a drilled hole, or beside the part.";
    RAMP_TOO_STEEP = "KC0516", "a ramp is steeper than the tool may go",
        "The tool goes down in material at a larger angle than `max_ramp_angle` of the tool.";
    TOO_DEEP = "KC0517", "a tool works deeper than it reaches",
        "A hole is deeper than the flutes of the drill: chips cannot leave. Or a wall is higher than the flutes of the mill, whose shank is as thick as its edges and rubs along it (a warning: say `shank_diameter` if it is thinner).";
    SPINDLE_WRONG = "KC0518", "the spindle turns the wrong way, or faster than the tool or machine may",
        "M4 turns a right-hand tool backwards: it does not cut, and breaks. `hand` of a tool and `max_speed` of tool and machine say what is right.";
    FEED_TOO_FAST = "KC0519", "a feed is faster than the machine or the tool may go",
        "The control lowers the feed to the largest one of its axes, or stops. Mostly a digit too many, or a feed per revolution where one per minute was meant.";
    CUTTING_DATA = "KC0520", "cutting data lie outside of wide bounds",
        "Feed per tooth, cutting speed or removal rate are outside of what any maker of this kind of tool recommends for any material. Or the tool turns or feeds with what was written for another one, because S or F stay in force over a tool change.";
    DWELL_IN_CUT = "KC0521", "the tool stands still in the cut",
        "A dwell or a stop while the tool touches material leaves a mark, work-hardens the wall and wears the edge. A dwell after a move straight along the tool (a hole, a spot face), and one of five turns or a quarter of a second, is right.";
    CHANGE_IN_STOCK = "KC0522", "the tool is changed inside the stock",
        "The spindle goes to the changing place from where it stands: through the wall of the pocket. Retract above the stock before the change.";
    NEVER_STARTED = "KC0523", "the spindle or the coolant never starts",
        "The program cuts with this tool and never switches on what the other tools have. Mostly a line was lost.";
    ABSURD_RUN = "KC0524", "a program runs absurdly long",
        "At the programmed feeds the program takes longer than a day, or a single move longer than four hours. Mostly a feed was typed in another unit.";
    OVERLAP_MISSED = "KC0525", "an overlap may have been missed",
        "The lines of the stock model stand so far apart, or the tool is so thin, that an overlap of more than 0.05 mm can lie between them. Or a tool passes an edge of the stock with less room than that: whether it clips the edge is not known. Lower `simulate.step`, or leave more room.";
    TURNED_INTO_STOCK = "KC0526", "a tool or holder turns through the stock",
        "The tool runs through stock at rapid while rotary axes turn. Retract before the axes turn.";
    AXIS_TOO_FAST = "KC0527", "an axis must move faster than it can",
        "The programmed feed asks an axis of the machine for more speed than its drive has. The control slows down on a good day and stops on a bad one. Mostly a rotary axis has to go the long way round.";
    NOT_MEASURED = "KC0528", "what an operation wants could not be measured",
        "No line of the stock model ends on the wanted wall or floor, so nothing is known of it. Lower `simulate.step`, or look whether the operation lies in the part.";
    UNKNOWN_START = "KC0529", "a move starts from a position that is not known",
        "The program does not say where the tool is before this move, and the move comes near the stock: what it meets on its way is not known. Position all axes first, above the part.";
    NOT_UNDERSTOOD = "KC0530", "a block was not understood",
        "The effect of this block on the control is not known, so what follows may be something else than what was simulated.";

    INCLINED_ENTRY = "KC0531", "a drill enters a face that leans",
        "A drill whose point touches a face on one side first is pushed aside: it starts off its place, or breaks. Mill the face flat first, or turn the plane of the drilling square to it. Asked for in programs of others; a planned drilling knows the surface that it enters.";
    TIP_NOT_CONTROLLED = "KC0532", "axes turn in a cut without control of the tool centre point",
        "The axes go straight from position to position, so that the tip leaves the line between two programmed points, by the value given. Mostly `G43.4`, `TRAORI` or `M128` was forgotten, or switched off too early.";

    NOT_CERTIFIED = "KC0533", "the cut stock is not as its certificate wants it",
        "In the certified mode (`--certified`) each end of a line of the stock is looked for at the tool that cut it. These were not found there: more may have been taken out of the stock than the tool takes. That is a fault of kinecut, not of the program: please report it with the program.";

    FEED_BEYOND = "KC0534", "a feed is more than the axes can hold",
        "On a curve an axis needs the more acceleration and jerk the faster it is run: at more than it has, the control slows down by itself, leaves the path, or shakes the machine. A program of kinecut has lower feed words there (`post = { feeds = \"within-limits\" }`, the default where the machine states its limits), and the summary says so; in other programs lower the feed, or give the path larger radii.";

    FACETS = "KC0535", "facets set the time of a program",
        "Short straight moves stand for a curve: at each joint the control brakes, or cuts the corner within its tolerance. A curve through the same points would be run faster, at the feed that its curvature allows. Post arcs or curves where the control has them, or give it a wider tolerance.";

    FIXTURE_MET = "KC0536", "a tool meets a clamp or a fixture",
        "Tool, shank or holder touch a body that a `[[fixture]]` of the job describes, at any moment of the move: at rapid both straight and axis by axis. The value is the length of the move over which they touch. A lift of the move by the height that the help names clears it; else move the clamp, or use a slimmer or longer tool.";
    FIXTURE_NEAR = "KC0537", "a tool comes near a clamp or a fixture",
        "Tool, shank or holder pass a body at less than `near` of its `[[fixture]]` (0.5 mm if nothing is said): an offset, a length or a place that is off by that much makes it a contact. Measure the body, or give it room; `near = 0` asks for none.";

    MACHINE_MET = "KC0538", "a body of the machine is met",
        "Bodies of the machine (`[[body]]` of its file), the tool, fixtures and the raw stock move against each other as the axes go: these two touch in the move named, at rapid straight or axis by axis. The place is in coordinates of the part. Two bodies of the machine on neighbouring links are not compared, as one is guided by the other. Use a longer tool, move or tilt the part, or let the move go another way. Where a body comes to the raw stock, the stock at that moment decides; a contact with the raw stock is a doubt where it does not, and where zeros or lengths may be off.";
    MACHINE_NEAR = "KC0539", "a body of the machine passes another body closely",
        "Two bodies pass at less than the `near` of one of them (0.5 mm if nothing is said): an offset or a length that is off by that much makes it a contact. Measure the bodies, or give them room; `near = 0` asks for none.";
    BODIES_OVERLAP = "KC0540", "bodies touch where the program begins",
        "Before anything has moved these two bodies already touch, so that one of them is drawn too large or at a wrong place, or the part does not lie where the job says. They are not compared any further. Correct the `[[body]]` or the `[[fixture]]`, or put both on one link where one carries the other.";

    CUTTING_LOAD = "KC0542", "a cut needs nearly all of the spindle, or more than it has",
        "Power and torque are those of what the tool takes from the simulated stock, after Kienzle with the constants of the material and sharp edges; they are right within a quarter, a worn edge needs 30 to 50 % more, and a fifth of the motor's power is taken as lost on its way. The machine's spindle_power and spindle_torque are what lasts. Take a smaller step, engagement or feed, or another speed where only one of the two is short.";
    TOOL_DEFLECTION = "KC0545", "the tool gives way more than the wall allows",
        "While it finishes the wall, the tip of the tool is pressed away by half of the cutting force, after Kienzle with sharp edges, by more than a third of the tolerance that the operation asks for, or more than 0.02 mm where it asks for none; the force is right within a quarter, and holder and spindle give way too. The simulated wall does not have this error. Take a spring pass, a smaller allowance, a smaller stepdown or feed, or a tool that sticks out less.";
    EDGE_RUBS = "KC0543", "the edges of a cutter rub",
        "No chip of the work is thicker than three tenths of the rounding of a usual edge: 0.010 mm of solid cutters, 0.020 mm of inserts. The edge presses and rubs instead of cutting, gets hot and wears. Take a higher feed per tooth.";
    START_DEPTH = "KC0544", "values to start with in a cut that is too deep for them",
        "Speeds and feeds to start with are for end mills that cut at most half their diameter deep where they cut in their full width. The simulated cut is deeper, in steel, iron or titanium. Take a smaller stepdown, or give the speed and the feed that the maker of the tool or the shop has for this depth.";
    FIXTURE_IN_STOCK = "KC0541", "a fixture and the raw stock are in the same place",
        "A body that a `[[fixture]]` describes reaches into the raw stock by more than a tenth of a millimetre. Mostly its `at` or its size is wrong, or the stock lies elsewhere: what is compared with tools is then not what is on the machine. A stock that rests on a body, or between two jaws, only touches them.";

    MESH_UNREADABLE = "KC0601", "a mesh file cannot be read",
        "The file is neither binary nor text STL, ends early, or holds numbers that are not finite.";
    MESH_OPEN = "KC0602", "a mesh does not close",
        "Each edge of a solid's surface belongs to exactly two triangles. The message gives a place where the surface is open. Repair it in the program that wrote it.";

    TOOL_VALUE = "KC0701", "a tool dimension is out of range",
        "A diameter, radius, length or angle of the tool is not positive, not finite, or contradicts another one.";
    MACHINE_CODE = "KC0702", "a coordinate code is not valid",
        "A code lists the motions from workpiece to tool: 1 2 3 translations along X Y Z, 4 5 6 rotations about them, one 0 for the bed.";
    MACHINE_AXIS = "KC0703", "the machine lacks an axis or a limit",
        "The program moves an axis that the machine does not have, or a limit contradicts itself.";

    CONTOUR = "KC0704", "the contour of a tool is not valid",
        "A contour runs from the bottom of the axis outwards and upwards to the top of the axis, with the material on its left: no gap, no element of no length, nothing beyond the axis, no crossing. The message names the element.";
    MACHINE_BODY = "KC0705", "a body of a machine is not valid",
        "A body of a machine file names the link that carries it (bed, work, spindle, or an axis of the code) and has one form: a box, a cylinder or a closed mesh, in the frame of the machine with all axes at zero.";
    TOOL_FILE = "KC0706", "a tool file cannot be read, or not used",
        "Tools are read from TOML with [[tool]], the tool table of LinuxCNC, Fusion .json and .tools, FreeCAD .fctb and .fctl. This file is another, is broken, or lacks something that the tool of an operation needs. `kinecut tools FILE` shows what it holds; `kinecut tools FILE --to toml` writes it as TOML, where the rest can be filled in.";
    TOOL_FIELDS = "KC0707", "fields of a tool file are not taken",
        "The file tells more of a tool than kinecut uses: each of these fields is named. Look at what shapes the tool: a neck, a relief, a taper that is named here is not simulated.";
    TOOL_ASSUMED = "KC0708", "what a tool file means was assumed",
        "A value without a unit, the tip of a cone that no field gives, or a kind or length that only a tool table tells. The message says what was taken. Write the tool as [[tool]] to be sure.";
    TOOL_CHOSEN = "KC0709", "a tool or its cutting data were chosen",
        "A tool of the job was taken before one of the same number in a tool file; none was taken for a program that calls a number of several tools; or an operation without a speed took that of the tool's preset for the material of the job. The message says which.";

    GEOMETRY = "KC0801", "a curve or body is not valid",
        "Numbers that are not finite, radii of opposite sign, a profile that crosses itself: see the message.";
    OUTLINE_FILE = "KC0802", "an outline cannot be read",
        "The drawing is malformed, has an element that is no outline, or does not say its unit. The message names the element and its place.";
    OUTLINE_OPEN = "KC0803", "an outline does not close",
        "The edges of a face form closed loops. The message gives the place and width of the gap: close it in the drawing, or allow a wider gap to be closed.";
    OUTLINE_CROSSES = "KC0804", "an outline crosses itself",
        "Two edges of an outline cross, touch or lie on one another. Which side is material cannot be told there.";
    OUTLINE_EDGE = "KC0805", "an edge of an outline is not valid",
        "An edge has no length, or numbers that are not finite.";
    OFFSET = "KC0806", "an offset of an outline cannot be made",
        "The path of a cutter runs at its radius from the outline. It was made in two ways, and neither has passed the check of its distance, its joints and its completeness: the drawing has details that are smaller than its accuracy. The message gives the place: simplify the drawing there, or take another cutter.";

    DRILL_CASE = "KC0901", "a drilling case contradicts itself",
        "A feed, speed, depth, length or diameter of a drilled hole is not usable, or two of its keys contradict each other. The message gives the bound.";
    DRILL_SURFACE = "KC0902", "a drill does not meet its surface",
        "The inclination of a plane lies between -90 and 90 degrees, the radius of a cylinder is positive, and the drill must lie within the cylinder: otherwise the hole opens sideways and is never fully inside.";
    CORNER_FIRST = "KC0903", "the corner of the drill touches before its tip",
        "The surface is steeper than the point, so that the outer corner touches first and the drill is pushed aside. Spot-face or mill a flat, use a flat-bottomed or a more pointed drill, or drill through a bush.";
    DRILL_MISSES = "KC0904", "a hole lies beside the part",
        "No part of the body lies below the drill: the point, the direction or the body is wrong.";
    DRILL_ZONES = "KC0905", "the stock is not where the zones were computed",
        "The simulated point is in material where the plan has air, or leaves it where the plan still has full feed. The surfaces given for the hole are not those of the stock at that moment: correct them, or the order of the operations.";
    DRILL_ADVICE = "KC0906", "a drilled hole is unusual",
        "The tool works outside of what its makers recommend. The message says why and what to look at.";
    TAP_CORE = "KC0907", "a core hole does not fit its tap",
        "A tap needs a hole that is there: made by an operation before it, by `drilled`, or stated as `core`. Its diameter lies between the minor diameter of the thread and the largest of class 6H (a tap that forms: D - 0.5 P to D - 0.42 P, the maker's data decide). A blind one is as deep, at its full diameter, as the thread, the lead of the tap and one pitch together. In a smaller or shorter hole the tap breaks.";
    TAP_MEETS = "KC0908", "a tap meets material",
        "A tap cuts or forms the thread in the wall of a hole that is there. In the simulated stock there is material within the core hole: it is not drilled, not there, or not so deep.";
    TAP_FEED = "KC0909", "a tap is not fed by its pitch",
        "A tap moves by its pitch with each revolution of the spindle, in and out, in the sense of its thread, as only the tapping cycle of the control can do it. A feed move, another pitch or the other sense breaks the tap or strips the thread. Write the cycle of the control with the pitch of the tap. A tapping cycle with a tool that the job does not state as a tap has no pitch to compare with.";

    FACE_CASE = "KC1001", "a face milling case contradicts itself",
        "A radius, feed, angle, weight or threshold of a milled face is not usable, or two of its keys contradict each other. The message gives the bound.";
    FACE_TOO_WIDE = "KC1002", "the part is wider than the cutter",
        "No orientation that is allowed lets one straight pass of this cutter cover the face with its margin. Take a larger cutter, several passes, or allow more orientations. The message says how many passes are needed.";
    FACE_EXITS = "KC1003", "the simulated exit angles are not those planned",
        "The cutter leaves the stock at another angle than the plan says, or at another place: the stock at that moment does not have the outline that was given. Correct the outline, or the order of the operations.";
    FACE_UNCUT = "KC1004", "a part of the face is not reached",
        "The passes of the cutter do not cover the whole face. The message gives a place that stays uncut.";
    FACE_ADVICE = "KC1005", "a milled face is unusual",
        "The cutter works outside of what its makers recommend, or the best placement was not proven best, or is sensitive to set-up, or the stock stands higher than planned. The message says why and what to look at.";
    BURRS = "KC1006", "burrs along the edges of a milled face",
        "An operation takes off the burrs that the face milling before it has left: on the edges whose exit angle is bad, or where a table of measured burrs gives more than a height. The message says what it found: no face, no table, no edge to treat, or burrs that it leaves. Heights are those of the table that the job gives, interpolated over the exit angle; they are not simulated.";

    EXPRESSION_SYNTAX = "KC1101", "a formula cannot be read",
        "A formula is written as in `R0 + a*cos(2*pi*t/p)`: numbers, names, the constants pi and e, the operators + - * / and ^ (or **), brackets, and functions, whose angles are radians. The message gives the column.";
    EXPRESSION_NAME = "KC1102", "a formula has a name that is not known",
        "Each name in a formula is one of the parameters or variables that are given beside it. The message says which are known.";
    EXPRESSION_SIZE = "KC1103", "a formula is too large",
        "Formulas that are put into one another grow. Simplify them, or divide the formula into several.";

    SURFACE_FORM = "KC1104", "a surface is not defined properly",
        "A surface has two generating lines, whose laws contain exactly two free variables between them, each with a domain, and otherwise only parameters with a value. Two equal motions that stand next to one another with constant laws are one motion given twice.";
    SURFACE_DEGENERATE = "KC1105", "the generating lines make no surface",
        "The derivatives of the shape-generation function by its two variables are parallel or vanish everywhere, or are not finite: both variables move the point along the same line.";
    SURFACE_TEXT = "KC1106", "the chain of a line cannot be read",
        "A chain is written as motions with their laws in brackets, from the work to the tool: \"6(phi) 1(R) 5(-alpha) 3(z)\". The message gives the column.";
    SURFACE_UNKNOWN = "KC1107", "there is no surface of this name",
        "The catalogue has surfaces by name; `kinecut surface` lists them. Another surface is given by its own directrix and generatrix.";
    SURFACE_FOLD = "KC1108", "a surface folds over or shrinks to a point",
        "Along a line of the domain the derivatives of the shape-generation function are parallel: the surface turns back there, or its generating line shrinks to a point. What is wanted beyond is not reached, or is reached twice. End the domain there.";
    SURFACE_SAMPLES = "KC1109", "a surface cannot be recognised from these points",
        "Recognition needs points with normals, or facets, that are finite, not all in one place, and enough of them.";

    DIRECTION_UNREACHABLE = "KC1111", "the tool axis cannot take a direction",
        "The rotary axes tilt the tool only within a range that follows from the angles between their axes and the tool: 0 to 180 degrees where they stand at right angles, 0 to 90 for a nutating axis at 45 degrees. The message says by how many degrees the direction lies outside. Tilt the workpiece, or take another machine.";
    TIP_UNREACHABLE = "KC1112", "the translations cannot bring the tip to the point",
        "At these positions of the rotary axes the translations do not span the space: a rotary axis stands between them and has turned one into the plane of the others, or the machine has fewer than three. The message says how far the tip stays away.";
    NO_CLOSED_FORM = "KC1113", "the chain has more axes than a pose determines",
        "Axis positions follow from a tip and a direction of the tool for up to two rotary axes and three translations. Hold the other axes at given positions.";
    POSE_NOT_USABLE = "KC1114", "a pose or an axis position is not usable",
        "A coordinate is not a finite number, or a direction of the tool has no length.";
    OUTSIDE_TRAVEL = "KC1115", "a pose lies outside of the travel of the axes",
        "None of the solutions of the pose, at no whole turn of the rotary axes, lies inside the travel of all axes. The message names the axis that lacks least. Move or turn the workpiece on the machine, or take a shorter tool.";
    PATH_BROKEN = "KC1116", "a path cannot be run without retracting the tool",
        "Between two poses a rotary axis must change to its other solution or go back by a turn, during which the tool would leave its path. Allow a retraction there, start at another turn, or incline the tool so that it stays away from the pole.";
    MACHINE_PRESET = "KC1117", "a machine is not known by this name",
        "Some machines are built in and known by name. Write the name of one of those, or a machine file of your own.";
    TURNS_AT_ONCE = "KC1118", "rotary axes would turn within no length of a move",
        "The tool passes along the first rotary axis (the pole), where that axis turns by up to half a turn within no length, and no division of the move helps. The same happens between two poses that are solved differently. Hold the axis, turn it beforehand with the tool retracted, or incline the tool so that it stays away from the pole.";
    TOO_MANY_PARTS = "KC1119", "a straight move would need too many parts",
        "On a control that interpolates the axes, a straight move of the tool is divided until the axes keep to it. The number of parts grows with the inverse root of the tolerance, which must be positive.";

    LAYOUT_SEARCH = "KC1121", "too many layouts to list",
        "The number of layouts grows as the factorial of the number of axes: at most eight axes are ordered. Leave out axes that are only set.";
    LAYOUT_QUERY = "KC1122", "a question about layouts contradicts itself",
        "A stroke, range, mass, weight or length is not finite or has the wrong sign, or a direction has no length. The message names it and gives the bound.";
    LAYOUT_NONE = "KC1123", "no layout satisfies the conditions",
        "Every layout was left out by one of the conditions. The message counts how many each one left out by itself: relax the one that leaves out most.";

    GENERATION_INPUT = "KC1131", "a surface cannot be compared or generated as given",
        "A range is empty, points are missing or not finite, a profile has a gap, or a tool and a motion do not match. Nothing was computed.";
    GENERATION_IMPOSSIBLE = "KC1132", "the machine cannot make this surface with this tool",
        "A pose of the tool cannot be reached: the machine lacks a motion, an axis would leave its travel, a direction is out of reach, an axis would have to jump at a singular place, or the tool would not be rigid. The message says which and by how much; layouts that can are listed beside it.";
    GENERATION_RESIDUAL = "KC1133", "the generated surface is not the wanted one",
        "Points that the tool generates are farther from the wanted surface than allowed, or parts of the wanted surface are not reached. The report names the worst place in workpiece coordinates.";

    MACHINE_IMPORT = "KC1141", "a configuration of another program cannot be read as a machine",
        "The configuration lacks something that the chain of axes needs, or names a kinematics module that is not known or contradicts itself. The message says which line; a machine can always be described by its axes in a machine file.";

    NO_MOTION = "KC1201", "a tool does not move",
        "A grazing curve needs a motion that moves the tool's surface: without velocity, or with a turn about its own axis alone, the tool sweeps itself.";
    POSE_NOT_RIGID = "KC1202", "a pose or its rate is not that of a rigid motion",
        "The matrix of a pose must be a right-handed rotation, and its derivative that of one: the product of its transpose with its rate is antisymmetric. Scaled, mirrored or mixed matrices give no velocity of a tool.";
    MOVE_NOT_POSSIBLE = "KC1203", "a move cannot be made",
        "An axis of the machine would leave its travel, a direction of the tool has no length or would have to turn upside down within one move, or a number is not finite. Nothing was swept.";
    SWEEP_TOLERANCE = "KC1204", "a swept volume needs a positive tolerance",
        "The number of facets grows with the inverse of the tolerance [mm], which must be positive and finite. A thousandth of a millimetre is fine for every look.";
    SWEEP_TOO_FINE = "KC1205", "a swept volume would need too many facets",
        "The tolerance is so small, or the tool turns so far in one move, that the mesh would not fit into memory. Take a larger tolerance, or divide the move.";
    CONE_CHAIN = "KC1210", "a chain of cones needs a number of cones",
        "An arc of a tool can be replaced by a chain of cones, from one to 100 000 of them. More would show rounding only; the exact curve of a torus costs no more than that of one cone.";
    GRAZING_MOTION = "KC1211", "a grazing curve needs one motion",
        "The motion of the tool is given in one of three ways: a twist (velocity of the point at the origin and turning), a pose matrix with its rate, or a moment of a move of a job's program. Give exactly one; of a program a line whose block moves the tool.";
    ENVELOPE_MOTION = "KC1212", "an envelope needs one move",
        "The move of the tool is given in one of four ways: the way of its tip with its direction (move), positions of a machine's axes (joints), a pose with a constant twist (screw), or a line of a job's program (of). Give exactly one; of a program a line whose block moves the tool.";
}

impl Code {
    /// The code as printed.
    pub fn as_str(self) -> &'static str {
        self.0
    }

    /// The code of this name, if there is one.
    pub fn parse(text: &str) -> Option<Code> {
        PAGES.iter().map(|p| p.code).find(|c| c.0.eq_ignore_ascii_case(text))
    }
}

/// The manual: one page for each code, in order.
pub fn manual() -> &'static [ManualPage] {
    PAGES
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }
}

impl Serialize for Code {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.0)
    }
}

impl<'de> Deserialize<'de> for Code {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Code, D::Error> {
        let text = String::deserialize(deserializer)?;
        Code::parse(&text).ok_or_else(|| serde::de::Error::custom(format!("unknown finding code `{text}`")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_is_unique_and_has_a_page() {
        let mut codes: Vec<_> = manual().iter().map(|p| p.code).collect();
        codes.sort_unstable();
        codes.dedup();
        assert_eq!(codes.len(), manual().len());
        assert!(manual().iter().all(|p| p.code.as_str().len() == 6 && p.text.len() > 40));
    }
}
